import re, sys, json
HERE='/work/main/assets/courses/how-a-story-is-told/'
sys.path.insert(0, HERE)
T={}
exec(open(HERE+'.en.py').read())
for l in ('pt','de'):
    try: exec(open(HERE+'.%s.py'%l).read())
    except FileNotFoundError: pass

K=lambda t,x,y,z: f"<key time='{t}' x='{x}' y='{y}' z='{z}'/>"
def P(a,x,y,z,hand=''):
    h=f" hand='{hand}'" if hand else ''
    return f"<palms{h}><key time='0' a='{a}' x='{x}' y='{y}' z='{z}'/></palms>"
def S(i,hand=''):
    h=f" hand='{hand}'" if hand else ''
    return f"<hand-shapes{h}><key time='0' id='{i}'/></hand-shapes>"
def M(*keys,hand=''):
    h=f" hand='{hand}'" if hand else ''
    return f"<motion{h} coords='speaker'>"+''.join(K(*k) for k in keys)+"</motion>"
# name: hand, duration, parts
G={
 'offer':('both',.9,[S(57),P(110,.15,.85,-.5),M((0,-6,11,-10),(.45,-8,14,-13.5))]),
 'open':('both',.7,[S(4),P(90,.6,.8,0),M((0,-4,11,-10),(.5,-9,12,-13))]),
 'shrug':('both',.6,[S(4),P(90,0,1,0),M((0,-8,12,-10),(.3,-13,15,-8))]),
 'you':('right',.7,[S(4),P(110,.15,.85,-.5),M((0,-6,11,-10),(.35,-7,14,-13.5))]),
 'youleft':('left',.7,[S(57),P(-110,-.15,.85,-.5),M((0,6,11,-10),(.35,8,14,-13))]),
 'precise':('right',.6,[S(27),P(150,.3,0,-1),M((0,-7,25,-11),(.18,-7,22,-13))]),
 'ring':('right',1.1,[S(27),P(150,.3,0,-1),M((0,-7,24,-11),(.2,-7,21.5,-13),(1,-7,22,-13))]),
 'flatdown':('right',.7,[S(1),P(90,0,-1,0),M((0,-7,20,-12),(.3,-9,12,-12))]),
 'all':('both',.6,[S(1),P(90,0,-1,0),M((0,-4,16,-13),(.4,-12,15,-10))]),
 'chest':('right',.9,[S(1),P(115,0,0,1),M((0,-6,17,-11),(.25,-4,18.5,-7))]),
 'chest2':('both',.8,[S(1),P(125,0,0,1),M((0,-8,15,-11),(.3,-6.5,16.5,-8.5))]),
 'small':('both',.7,[S(9),P(90,1,0,0),M((0,-6,12,-12),(.3,-4.3,11,-13))]),
 'tiny':('right',.7,[S(25),P(150,.6,0,-.8),M((0,-8,19,-11),(.3,-7,22,-12))]),
 'huge':('both',.9,[S(4),P(90,1,0,0),M((0,-6,14,-13),(.6,-14,19,-9.5))]),
 'box':('both',.8,[S(10),P(90,1,0,0),M((0,-7,13,-13),(.3,-5,12,-13))]),
 'one':('right',.3,[S(19),P(180,0,0,-1),M((0,-7,26,-11),(.15,-7,24.5,-13))]),
 'two':('right',.3,[S(38),P(180,0,0,-1),M((0,-7.5,26,-11),(.15,-7.5,24.5,-13))]),
 'three':('right',.6,[S(47),P(180,0,0,-1),M((0,-8,26.5,-11),(.15,-8,24.5,-13.5))]),
 'beat1':('right',.25,[S(27),P(150,.3,0,-1),M((0,-6,22,-11),(.15,-6,19,-13))]),
 'beat2':('right',.25,[S(27),P(150,.3,0,-1),M((0,-7.5,22,-11),(.15,-7.5,19,-13))]),
 'beat3':('right',.5,[S(27),P(150,.3,0,-1),M((0,-9,22.5,-11),(.15,-9,18.5,-13))]),
 'pointfar':('right',1.2,[S(19),P(50,0,-1,0),M((0,-9,20,-11),(.35,-14,24,-12),(1.1,-14,24,-12))]),
 'pointagain':('right',.7,[S(19),P(50,0,-1,0),M((0,-9,19,-11),(.2,-14,22,-12))]),
 'pointleft':('left',1,[S(19),P(-50,0,-1,0),M((0,8,18,-12),(.3,13,21,-11),(.9,13,21,-11))]),
 'know':('right',.6,[S(19),P(180,1,0,0),M((0,-6,25,-10),(.25,-6,28,-11))]),
 'stop':('right',.9,[S(1),P(180,0,0,-1),M((0,-5,18,-8),(.25,-5.5,20,-14),(.85,-5.5,20,-14))]),
 'see':('left',.9,[S(4),P(-110,-.15,.85,-.5),M((0,5,12,-10),(.4,9,15,-13))]),
 'no':('both',.9,[S(1),P(180,0,0,-1),M((0,-5,18,-9),(.2,-7,20,-13),(.5,-5.5,20,-13),(.8,-7.5,20,-13))]),
 'door':('right',.7,["<palms><key time='0' a='90' x='0' y='0' z='1'/><key time='0.4' a='50' x='0' y='-1' z='0'/></palms>",S(1),M((0,-2,18,-10),(.4,-13,17,-11))]),
 'step':('right',.7,[S(1),P(90,1,0,0),M((0,-5,16,-8),(.35,-5,16,-15))]),
 'away':('right',.6,[S(1),P(50,0,-1,0),M((0,-6,17,-11),(.35,-14,16,-11))]),
 'thread':('both',.9,["<hand-shapes><key time='0' id='24'/></hand-shapes>",P(90,1,0,0),M((0,-3.5,16,-13),(.6,-9,17,-12))]),
 'vague':('both',.9,[S(7),P(90,0,-1,0),M((0,-5,14,-13),(.3,-7,15,-12),(.6,-5,14,-13),(.85,-7,15,-12))]),
 'cap':('right',.9,[S(24),P(150,.2,0,-1),M((0,-7,30,-9),(.35,-6.5,33.5,-7.5),(.8,-6.5,33.5,-7.5))]),
 'mug':('right',.9,[S(58),P(90,1,0,0),M((0,-4,13,-12),(.45,-4.5,19,-12))]),
 'hook':('left',.9,[S(20),P(-90,-1,0,0),M((0,7,17,-12),(.4,10,22,-11),(.8,10,21,-11))]),
 'mugs':('both',1.2,[S(20),P(90,1,0,0),M((0,-7,18,-12),(.5,-9,22,-11),(1.1,-9,21,-11))]),
 'build':('both',1.2,[S(59),P(90,1,0,0),M((0,-6,9,-13),(.5,-6,14,-13),(1.1,-7,19,-12.5))]),
 'plain':('right',3.2,[S(1),P(90,0,-1,0),M((0,-1,15,-14),(3,-14,16,-10))]),
 'gone':('right',.45,[S(1),P(50,0,-1,0),M((0,-3,19,-13),(.35,-14,18,-10))]),
 'lamp':('right',1.1,[S(14),P(180,1,0,0),M((0,-9,18,-11),(.5,-10,26,-11),(.9,-10,25,-11))]),
 'lan':('right',1.1,[S(14),P(180,1,0,0),M((0,-8,14,-11),(.5,-9,19,-12),(1,-9,19,-12))]),
 'lanwave':('right',2.4,[S(14),P(180,1,0,0),M((0,-10,28,-10),(.4,-13,31,-9.5),(.85,-9,32,-9.5),(1.3,-13,32,-9.5),(1.75,-9,32,-9.5),(2.2,-12,31,-9.5))]),
 'market':('both',.8,[S(4),P(90,0,1,0),M((0,-6,11,-10),(.4,-10,15,-12))]),
 'stand':('both',.8,[S(1),P(90,0,-1,0),M((0,-6,17,-12),(.35,-8,11,-12))]),
 'tall':('both',.9,[S(1),P(90,0,1,0),M((0,-7,10,-11),(.6,-9,18,-12))]),
 'sink':('both',1.1,[S(0),P(90,0,-1,0),M((0,-6,15,-11),(.8,-7,8,-10))]),
 'tray':('both',1.1,[S(1),P(90,0,1,0),M((0,-6,13,-10),(.4,-7,14,-14.5),(1,-7.3,14,-14.5))]),
 'turn':('right',.9,["<palms><key time='0' a='90' x='0' y='-1' z='0'/><key time='0.3' a='90' x='1' y='0' z='0'/><key time='0.6' a='90' x='0' y='1' z='0'/></palms>",S(4),M((0,-6,13,-13),(.3,-8,16,-13),(.6,-9,15,-13))]),
 'down':('right',1,[S(1),P(90,0,-1,0),M((0,-7,22,-12),(.8,-9,9,-12))]),
 'case':('right',.8,[S(14),P(90,1,0,0),M((0,-9,13,-9),(.4,-10,8,-9))]),
 'lift':('right',1.8,[S(4),P(180,0,0,-1),M((0,-8,18,-11),(.6,-10,27,-11),(1.6,-10,27,-11))]),
 'hang':('both',.9,[S(0),P(90,1,0,0),M((0,-8,9,-9),(.6,-9,5,-8))]),
 'fog':('both',1.4,[S(4),P(90,0,-1,0),M((0,-4,13,-14),(.6,-10,15,-12),(1.2,-13,20,-9))]),
 'front':('right',1,[S(19),P(50,0,-1,0),M((0,-8,18,-11),(.35,-13,19,-13),(.9,-13,19,-13))]),
 'climb':('right',.8,[S(38),P(90,0,-1,0),M((0,-8,23,-12),(.6,-9,12,-13))]),
 'watch':('left',2.4,[S(14),P(-90,0,-1,0),M((0,7,13,-11),(.4,4.5,17,-12.5),(2.3,4.5,17,-12.5))]),
 'laugh':('both',.8,[S(4),P(90,1,0,0),M((0,-6,15,-12),(.2,-6.5,17.5,-12),(.4,-6,15,-12),(.6,-6.5,17.5,-12))]),
 'window':('right',.8,[S(1),P(90,1,0,0),M((0,-5,17,-9),(.4,-8,19,-14))]),
 'four':('right',1,[S(5),P(180,0,0,-1),M((0,-8,26,-11),(.2,-8,24,-13.5),(.9,-8,24,-13.5))]),
 'letsink':('right',1.2,[S(57),P(90,0,-1,0),M((0,-7,17,-13),(1,-8,10,-12))]),
 'stilltalk':('right',.6,[S(13),P(90,1,0,0),M((0,-6,19,-11),(.25,-6,19,-14))]),
 'apart':('both',.8,[S(44),P(90,1,0,0),M((0,-4,15,-13),(.5,-11,15,-11))]),
 'curve':('right',2.4,[S(19),P(90,0,-1,0),M((0,-1,24,-13),(1,-6,12,-13.5),(2.2,-13,25,-10.5))]),
 'circle':('right',1.2,[S(19),P(150,.3,0,-1),M((0,-6,16,-13),(.28,-10,20,-12),(.56,-6,24,-13),(.84,-2.5,20,-13.5),(1.12,-6,16,-13))]),
 'wavehand':('right',1.6,[S(4),P(180,0,0,-1),M((0,-9,26,-11),(.3,-12,28,-10),(.65,-8,28,-11),(1,-12,28,-10),(1.35,-9,27,-11))]),
 'count1':('right',.5,[S(19),P(180,0,0,-1),M((0,-7,25,-12))]),
 'count2':('right',.5,[S(38),P(180,0,0,-1),M((0,-7,25,-12))]),
 'count3':('right',.7,[S(47),P(180,0,0,-1),M((0,-7,25,-12))]),
}
out=[]; ind=2
def w(s): out.append('  '*ind+s if s else '')
def mk(id,m): return id+'_'+m
def esc(s): return s.replace('&','&amp;').replace("'", '&apos;')
def speech(id):
    s=' '.join(L[id].split())
    s=re.sub(r'\{(\w+)\}',lambda m:f"<tm name='{mk(id,m[1])}'/>",s)
    s=re.sub(r'\*\*(.+?)\*\*',r"<emph level='strong'>\1</emph>",s)
    s=re.sub(r'\*(.+?)\*',r'<emph>\1</emph>',s)
    s=re.sub(r'\|(\d+)\|',r"<break msec='\1'/>",s)
    return s
def wrap(s,width=118):
    # lines break at spaces outside of tags
    toks=re.findall(r'(?:<[^>]*>|[^\s<])+',s); line=''; res=[]
    for t in toks:
        if line and len(line)+len(t)+1>width: res.append(line); line=t
        else: line=(line+' '+t) if line else t
    res.append(line); return res
def voice(id,at=0):
    w(f"<voice-text time='{at}'>"); 
    global ind
    ind+=1
    for l in wrap(speech(id)): w(l)
    ind-=1
    w("</voice-text>")
def gest(id,m,name,off=-0.1,note=None):
    global ind
    hand,dur,parts=G[name]
    time=f"{mk(id,m)}{off:+.2f}".rstrip('0').rstrip('.')+'s'
    if note: w(f"<!-- {note} -->")
    w(f"<gesture-key time='{time}' duration='{dur:g}' handedness='{hand}'>")
    ind+=1
    order={'<h':0,'<p':1,'<m':2}
    for p in sorted(parts,key=lambda p:order[p[:2]]): w(p)
    ind-=1
    w("</gesture-key>")
def face(id,m,param,value,hold,att=.4,rel=.8,off=0):
    t=f"{mk(id,m)}{off:+.2f}s" if m else f"{off:g}"
    w(f"<body-animate-ADSR-control-parameter time='{t}' parameterId='{param}' attackDurationTime='{att:g}' attackValue='{value:g}' decayDurationTime='0.2' decayValue='{value:g}' sustainDurationTime='{hold:g}' releaseDurationTime='{rel:g}'/>")
def head(id,m,off,**j):
    a=' '.join(f"{k}='{v}'" for k,v in j.items())
    w(f"<body-non-deterministic-fk time='{mk(id,m)}{off:+g}s' manipulator='head' {a}/>")
def headstop(id,m,off): w(f"<body-non-deterministic-stop time='{mk(id,m)}{off:+g}s' manipulator='head'/>")
def anim(id,m,name,off=0):
    w(f"<body-deterministic-primitive time='{mk(id,m)}{off:+g}s' primitive='push' player='body' animationSetName='{name}'><animation-style playbackStyle='temporaryIterations'/></body-deterministic-primitive>")
def say(id,*todo,gap=.5,note=None,pre=()):
    global ind
    if note: w(f"<!-- {note} -->")
    w(f"<par time='{gap:g}'>"); ind+=1
    for p in pre: w(p)
    voice(id)
    for t in todo:
        if callable(t): t(id)
        else: gest(id,*t)
    ind-=1; w("</par>")
F=lambda m,param,value,hold,**k: (lambda id: face(id,m,param,value,hold,**k))
H=lambda m,off,**j: (lambda id: head(id,m,off,**j))
HS=lambda m,off: (lambda id: headstop(id,m,off))
A=lambda m,name,off=0: (lambda id: anim(id,m,name,off))
R=lambda s: (lambda id: w(s))
def emo(type_,pot=None,dur=None,time=0):
    s=f"<r:emotion time='{time:g}' type='{type_}'"
    if pot: s+=f" potential='{pot:g}'"
    if dur: s+=f" duration='{dur:g}'"
    return s+"/>"
def answer(to,id,*todo,emotion=None,note=None):
    global ind
    if note: w(f"<!-- {note} -->")
    w(f"<r:answer to='{to}'>"); ind+=1
    w("<seq time='0'>"); ind+=1
    if emotion: w(emo(*emotion))
    say(id,*todo,gap=.2)
    ind-=1; w("</seq>")
    ind-=1; w("</r:answer>")
def ask(name,type_,points,tries,opts,answers,limit=None,asked=None,fig='you',m=None):
    global ind
    q=L['q_'+name]
    s=f"<r:ask time='0.3' name='{name}' type='{type_}' prompt='{esc(q['prompt'])}' points='{points}'"
    if tries>1: s+=f" tries='{tries}'"
    if 'hint' in q: s+=f" hint='{esc(q['hint'])}'"
    if limit: s+=f" limit='{limit}'"
    w(s+">"); ind+=1
    for n,attrs in opts:
        o=q.get(n,{})
        if isinstance(o,str): o={'text':o}
        a=''.join(f" {k}='{esc(v)}'" for k,v in {**o,**attrs}.items())
        w(f"<r:option name='{n}'{a}/>")
    for a in answers: a()
    ind-=1; w("</r:ask>")
    w(emo('neutral'))
def part(name,fn):
    global ind
    w(''); w(f"<r:part time='1' name='{name}' title='{esc(L['t_'+name])}'>"); ind+=1
    w("<seq time='0'>"); ind+=1
    fn()
    ind-=1; w("</seq>"); ind-=1; w("</r:part>")
def iff(cond,fn):
    global ind
    w(f"<r:if {cond}>"); ind+=1; w("<seq time='0'>"); ind+=1
    fn(); ind-=1; w("</seq>"); ind-=1; w("</r:if>")
CAM=lambda shot,tr,time=0,angle=None: f"<r:camera time='{time:g}' shot='{shot}'"+(f" angle='{angle}'" if angle else '')+f" transition='{tr:g}'/>"
def words():
    w("<!-- Openings. -->")
    w(CAM('medium',1.5))
    say('door',('door','door'),('short','small'),('no','no'),('step','step'),('b1','beat1'),('b2','beat2'),('b3','beat3'))
    say('askopening',('doors','open'))
    ask('opening','choice',2,1,[('topic',{}),('man',{'right':'true'}),('praise',{})],[
        lambda:answer('right','openingright',('y','precise'),('why','know'),emotion=('joy',3.5,3)),
        lambda:answer('praise','openingpraise',('y','chest'),('let','offer'),emotion=('kidding',3,2),note='Its own answer for those who want to praise the story.'),
        lambda:answer('wrong','openingwrong',('y','shrug'),('bread','away'),emotion=('disappointment',3,2))])
    w("<!-- The branch: who chose another door hears an example, who chose the right one takes a short way. Both meet again. -->")
    w("<r:set time='0' name='way' value='short'/>")
    w("<r:if name='opening' is='wrong'><r:set time='0' name='way' value='long'/></r:if>")
    iff("name='way' is='long'",lambda:say('branchlong',('l1','no'),('l2','pointfar'),('l3','open'),('you','you'),F('again','Surprise',.5,.8)))
    iff("name='way' is='short'",lambda:say('branchshort',('why','know'),('th','thread')))
    w("<!-- Pictures. -->")
    say('pictures',('vague','vague'),A('nod','nod',-.1),('cap','cap'),('mug','mug'),('hook','hook'),('eleven','stop',.3),('lonely','shrug'),('you','you'),F('eleven','Sadness',.35,1.6,off=.6))
    w("<!-- Pauses: before a word, and after one. -->")
    say('pauses',('noth','stop'),('bef','stop',.3),('wait','precise'),('aft','see'),('cat','no'),('build','build'))
    say('askpause',('fill','one'))
    ask('pause','gap',2,2,[('before',{}),('after',{})],[
        lambda:answer('right','pauseright',('y','ring'),emotion=('satisfaction',5,2)),
        lambda:answer('wrong','pausewrong',('y','stop'),('z','see'),emotion=('hope',3,3))])
    w("<!-- Rhythm. -->")
    say('rhythm',('long','plain'),('short','small'),('r1','beat1'),('r2','beat2'),('r3','beat3'),('gone','gone',-.05),('lamp','lamp'),('why','shrug'),('thread','thread'),
        F('r3','Surprise',.4,.6))
def bodyface():
    w("<!-- Hands. -->")
    w(CAM('full',2))
    say('hide',('look','open'),
        R("<body-deterministic-primitive time='hide_hide-0.2s' primitive='push' player='body' animationSetName='hands-behind'/>"),
        F('hide','LipSeal',.5,1.5,off=.4),
        R("<body-deterministic-primitive time='hide_out-0.7s' primitive='pop' player='body'/>"),
        ('out','open'))
    say('four',('offer','offer'),('pinch','precise'),('flat','flatdown'),('chest','chest'),pre=[CAM('medium',2)])
    say('askhands',('dur','youleft'))
    ask('hands','match',4,2,[('palms',{}),('fingers',{}),('flat',{}),('chest',{})],[
        lambda:answer('right','handsright',('y','four'),('z','market'),emotion=('pride',4,3)),
        lambda:answer('wrong','handswrong',('a','offer'),('b','precise'),('c','flatdown'),('d','chest'),emotion=('liking',4,4))],limit='60')
    w("<!-- Size. -->")
    say('size',('tiny','tiny'),('huge','huge'),('box','box'),F('toy','Kidding',.6,.8,off=.1))
    w("<!-- Eyes, hand, word. -->")
    say('gaze',('see','chest'),F('see','GazeX',-.8,2.6,att=.3,rel=.4,off=.9),H('see',.95,j3='-22'),('there','pointfar',-.35),HS('there',1.5),
        ('b1','beat1'),('b2','beat2'),('b3','beat3'),('bad','pointagain',-.7),F('bad','GazeX',-.6,.5,att=.2,rel=.3,off=.7),('nobody','shrug'))
    say('askfirst',('f','chest2'),pre=[CAM('full',1.5)])
    ask('first','point',1,2,[('eyes',{'at':'skull','right':'true'}),('hand',{'at':'r_wrist'}),('shoulder',{'at':'l_shoulder'})],[
        lambda:answer('right','firstright',('y','know'),('you','you'),emotion=('joy',3,2)),
        lambda:answer('wrong','firstwrong',('y','know'),F('happens','GazeX',.8,1.4,att=.25,rel=.4,off=.5),H('happens',.55,j3='22'),('z','pointleft'),HS('z',1.3),emotion=('kidding',3,2))])
    w("<!-- Two smiles. -->")
    say('smile',F('pol','ZygomaticusMajor',.55,2.0,att=.35,rel=.5,off=.5),F('real','Joy',.9,2.6,att=.7,rel=1.4,off=.2),F('dog','Kidding',.5,.7,off=.2),pre=[CAM('closeUp',2)])
    w("<!-- Standing. -->")
    say('stand',('stand','stand'),('tall','tall'),('express','huge'),('sink','sink'),F('sink','Sadness',.6,2.6,att=.8,rel=1,off=.1),H('sink',.2,j2='8',j4='10'),HS('body',0),('body','open'),pre=[CAM('full',1.5)])
def feeling():
    w("<!-- The turn. -->")
    w(CAM('medium',2))
    say('feel',('tray','tray'),('lead','step'),('aside','door'),('turn','turn'),('down','down'))
    w("<!-- The tale. Dusk: a cooler, darker light, low music, a near camera. -->")
    w("<r:light time='0.6' color='#9fb4d8' brightness='0.6' transition='4'/>")
    w("<r:music time='0' valence='negative' volume='0.35' fade='4'/>")
    w(emo('distress',2.5,12))
    say('tale1',('case','case'),('lift','lift',-.3),('not','hang'),gap=1.5)
    say('tale2',('cap','cap'),('lan','lan'),('thru','gone'),gap=.6)
    w("<!-- The lowest point. -->")
    w(emo('distress',5,14)); w(CAM('closeUp',5))
    say('tale3',('reach','lamp',.1),('fog','fog'),gap=.6)
    w("<!-- Something comes: the music is gone, the voice holds its breath. -->")
    w("<r:music time='0' fade='1.5'/>"); w(emo('neutral')); w(CAM('medium',3))
    say('tale4',F('rails','Surprise',.5,1.2,off=.2),F('rails','GazeX',-.7,3.5,att=.4,rel=.6,off=1.2),('stood','stand'),('no','all'),('front','front'),F('driver','Surprise',.7,1,off=.1),gap=.4)
    w(emo('hope',3,6))
    say('tale5',('climb','climb'),('watch','watch',-.2),F('watch','GazeY',-.7,2.2,att=.3,rel=.4),H('watch',0,j4='9'),HS('eleven',-.2),gap=.4)
    w("<!-- The turn: warm light, music, joy. -->")
    w("<r:light time='0' color='#ffd9a0' brightness='1.2' transition='2.5'/>")
    w("<r:music time='0' valence='positive' volume='0.4' fade='2'/>")
    w(emo('joy',6,14)); w(CAM('full',3))
    say('tale6',('laugh','laugh'),('all','all'),('win','window'),('lifted','lamp'),('wave','lanwave',-.1),gap=.2)
    w(emo('love',5,8))
    say('tale7',('four','four'),('mugs','mugs'),gap=.4,pre=[CAM('medium',3)])
    w("<!-- And then nothing. The silence belongs to the story. -->")
    w("<r:music time='0' fade='3'/>")
    w("<null time='3'/>")
    w(emo('neutral'))
    w("<r:light time='0' color='#ffe9cf' brightness='1' transition='3'/>")
    say('silence',('noth','no'),('that','stilltalk'),('sink','letsink'),('this','count1',.7),('this','count2',1.5),('this','count3',2.3),gap=.3)
    say('askbones',('b','apart'))
    ask('bones','order',3,2,[(n,{}) for n in ('hand','years','fog','door','wave')],[
        lambda:answer('right','bonesright',('y','curve'),emotion=('admiration',3,3)),
        lambda:answer('wrong','boneswrong',('y','one'),('yy','two'),('fog','three'),('z','door'),emotion=('hope',3,4))])
    w("<!-- The ending. -->")
    say('ending',('circ','circle'))
    say('askchange',('a','you'))
    ask('change','text',3,2,[('well',{'right':'true'}),('lantern',{})],[
        lambda:answer('right','changeright',('y','wavehand'),('little','tiny'),emotion=('love',6,4)),
        lambda:answer('lantern','changelantern',('lan','lan'),('y','lanwave'),emotion=('kidding',3,3)),
        lambda:answer('wrong','changewrong',('y','wavehand'),('but','chest'),emotion=('relief',4,4))])
    w("<!-- The closing, by what was reached. -->")
    def high():
        w(emo('gratitude',4,4)); say('closehigh',('y','offer'),('one','one'),('tell','step'))
    def low():
        w(emo('liking',5,4)); say('closelow',('y','shrug'),('back','youleft'),('tell','step'))
    iff("name='score' above='9'",high)
    iff("name='score' below='10'",low)
    w(emo('neutral'))
    say('last',('quiet','stop'),A('wave','wave',.6),F('wave','Joy',.8,3,att=.6,rel=1.5,off=.4),gap=.6,pre=[CAM('full',3)])
    w("<null time='1.5'/>")
HEADS={'en':('sofia','en'),'pt':('nuno','pt-PT'),'de':('lia','de')}
def build(lang):
    global L,out,ind
    L=T[lang]; out=[]; ind=0
    fig,lg=HEADS[lang]
    w('<?xml version="1.0" encoding="UTF-8"?>')
    w(f"<!-- {L['comment']} -->")
    w(f"<eml xmlns:r='urn:raconteur:eml:1' name='{esc(L['title'])}'>")
    ind=1; w("<head>"); w(f"  <r:performer figure='{fig}' language='{lg}'/>"); w("</head>"); w("<body>")
    ind=2
    w("<gesture-is-on time='0' isOn='true'/>")
    w("<body-player-add time='0' name='body' type='multiple' numberOfLayers='1'/>")
    w("<r:light time='0' color='#ffe9cf' brightness='1'/>")
    w("<r:camera time='0' shot='medium' angle='eye'/>")
    w("<r:music time='0' valence='neutral' volume='0.25' fade='1'/>")
    w(''); w("<seq time='0'>"); ind=3
    say('hook',('man','pointfar'),('now','you'),('name','shrug'),gap=1)
    w("<r:music time='0' fade='4'/>")
    say('plan',('amaro','open'),('g1','one'),('g2','two'),('g3','three'),('catch','chest'),F('catch','Kidding',.6,1.4))
    part('words',words); part('body',bodyface); part('feeling',feeling)
    ind=2; w("</seq>"); ind=1; w("</body>"); ind=0; w("</eml>")
    return '\n'.join(out)+'\n'
for lang in T:
    # the marks of a translation are those of the English text
    for k,v in T['en'].items():
        if isinstance(v,str) and not k.startswith('t_') and k not in('title','comment'):
            a=sorted(re.findall(r'\{(\w+)\}',v)); b=sorted(re.findall(r'\{(\w+)\}',T[lang].get(k,'')))
            if a!=b: print(lang,k,'marks differ',a,b)
    path=HERE+('' if lang=='en' else lang+'/')+'story.eml'
    open(path,'w').write(build(lang))
    n=sum(len(re.sub(r'<[^>]*>|\{\w+\}|\|\d+\||\*','',v).split()) for k,v in T[lang].items() if isinstance(v,str) and not k.startswith('t_') and k not in('title','comment'))
    print(lang,n,'words')
