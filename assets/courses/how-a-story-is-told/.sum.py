import json,subprocess,sys
f=sys.argv[1]
d=json.loads(subprocess.run(['target/debug/raconteur','timeline','--format','json',f],capture_output=True,text=True).stdout)
c=d['clauses']; src=open(f).read().split('\n')
skip=0; ans=[]; 
for x in c:
    if x['element'] in('answer','r:answer','if','r:if'):
        print(x['element'],src[x['line']-1].strip()[:60],round(x['end']-x['start'],1)); ans.append(x)
print('total',d['duration'])
