//! English rules. The phones of letters are those of H. S. Elovitz, R. W. Johnson, A. McHugh and J.
//! E. Shore, *Automatic Translation of English Text to Phonetics by Means of Letter-to-Sound
//! Rules*, NRL Report 7948, 1976; rewritten for the mouth, which does not distinguish voiced from
//! voiceless phones.

/// Words that no rule would find, with their phones.
pub(super) const WORDS: &str = "
a ax|the dh ax|of ah v|to t ax|into ih n t uw|onto aa n t uw|do d uw|who hh uw|whose hh uw z|whom hh uw m
two t uw|one w ah n|once w ah n s|you y uw|your y ao r|youth y uw th|was w aa z|what w ah t|were w er
are aa r|there dh eh r|where w eh r|their dh eh r|here hh ih r|said s eh d|says s eh z|have hh ae v|having hh ae v ih ng
has hh ae z|had hh ae d|is ih z|as ae z|at ae t|an ae n|and ae n d|any eh n iy|anything eh n iy th ih ng|many m eh n iy
he hh iy|she sh iy|we w iy|me m iy|be b iy|they dh ey|from f r ah m|done d ah n|gone g ao n|none n ah n|does d ah z|goes g ow z
live l ih v|lived l ih v d|lives l ih v z|give g ih v|gives g ih v z|given g ih v ax n|river r ih v axr
arrive ax r ay v|alive ax l ay v|get g eh t|gets g eh t s|getting g eh t ih ng|gift g ih f t|together t ax g eh dh axr
forget f axr g eh t|begin b ih g ih n|tiger t ay g axr|anger ae ng g axr|hanger hh ae ng axr
people p iy p ax l|beautiful b y uw t ax f ax l|great g r ey t|break b r ey k|heart hh aa r t|bear b eh r|wear w eh r
read r iy d|friend f r eh n d|friends f r eh n d z|been b ih n|eye ay|eyes ay z|height hh ay t
how hh aw|now n aw|brow b r aw|brows b r aw z|cow k aw|cows k aw z|wow w aw|allow ax l aw|known n ow n|grown g r ow n|shown sh ow n|own ow n
our aw axr|hour aw axr|hours aw axr z|four f ao r|pour p ao r|honest aa n ax s t|should sh uh d|though dh ow|although ao l dh ow
through th r uw|enough ih n ah f|rough r ah f|tough t ah f|cough k ao f|laugh l ae f|laughed l ae f t|country k ah n t r iy
blood b l ah d|flood f l ah d|lose l uw z|month m ah n th|monkey m ah ng k iy|money m ah n iy|front f r ah n t|son s ah n
won w ah n|tongue t ah ng|women w ih m ih n|woman w uh m ax n|every eh v r iy|everything eh v r iy th ih ng
very v eh r iy|water w ao t axr|father f aa dh axr|rather r ae dh axr|put p uh t|upon ax p aa n|welcome w eh l k ax m|doing d uw ih ng|being b iy ih ng|ones w ah n z|minutes m ih n ax t s|don't d ow n t|won't w ow n t|can't k ae n t|isn't ih z ax n t|i'm ay m|i'll ay l|you'll y uw l|he'll hh iy l|she'll sh iy l|we'll w iy l|they'll dh ey l|it'll ih t ax l|let's l eh t s|push p uh sh|bush b uh sh
busy b ih z iy|business b ih z n ax s|sure sh uh r|sugar sh uh g axr|minute m ih n ax t|study s t ah d iy|often ao f ax n
answer ae n s axr|sword s ao r d|island ay l ax n d|wind w ih n d|wolf w uh l f|both b ow th|also ao l s ow|half hh ae f
again ax g eh n|against ax g eh n s t|only ow n l iy|until ax n t ih l|key k iy|keys k iy z|final f ay n ax l|ghost g ow s t|shoe sh uw|shoes sh uw z|type t ay p|if ih f|no n ow
its ih t s|him hh ih m|ache ey k|evening iy v n ih ng|even iy v ax n|school s k uw l|science s ay ax n s
mr m ih s t axr|mrs m ih s ax z|dr d aa k t axr|animal ae n ax m ax l|able ey b ax l|avenue ae v ax n uw|magic m ae jh ih k
b b iy|c s iy|d d iy|g jh iy|k k ey|l eh l|m eh m|n eh n|p p iy|q k y uw|r aa r|s eh s|t t iy|u y uw|v v iy|w d ah b ax l y uw|x eh k s|z z iy
";

/// Letter-to-sound rules of English. `%` is an ending: -e, -es, -ed, -er, -ers, -ing, -ings, -ely.
pub(super) const RULES: &str = "
[augh]t ao|[augh] ae f|[ait] ey t|[air] eh r|[ware] w eh r|[ai] ey|[ay] ey|[au] ao|_[aw]a ax w|_[awh] ax w|[aw] ao|[ah] aa|[ae] iy
S[ally]_ ax l iy|[all] ao l|[alk] ao k|[alm] aa m|[alf] ae f|S[al]_ ax l|S[als]_ ax l z|[al]C ao l
_[arr] ax r|[arr] ae r|w[ar] ao r|S[ar]_ axr|S[ward]_ w axr d|S[wards]_ w axr d z|S[ard]_ axr d|_[ar]V ax r|[ar]V eh r|[ar] aa r
S[age]_ ax jh|S[able]_ ax b ax l|S[ance]_ ax n s|S[ant]_ ax n t|S[an]_ ax n|S[and]_ ax n d|S[ace]_ ax s
[ange] ey n jh|[aste] ey s t|[a]C% ey|[a]Cy_ ey|[a]Cen_ ey|[a]Cle_ ey|[a]tio ey|[a]Cio ey|[a]Cia ey|S[a]_ ax|[a]_ aa|_[a]CV ax|_[acc] ax k|_[att] ax t
_[app]e ax p|wh[a] ah|w[a]v ey|w[a] aa|qu[a] aa|S[a]CV ax|[a] ae
[bt]_ t|[b] b
[sch] s k|[chr] k r|[tch] ch|[ch] ch|[cial] sh ax l|[cious] sh ax s|[cient] sh ax n t|[cian] sh ax n
[cc]F k s|[sc]F s|[c]F s|[ck] k|[cq] k|[c] k
[dge] jh|[dg] jh|[dj] jh|[du]V jh uw|[d] d
t[ed]_ ax d|d[ed]_ ax d|S[ed]_ d|s[es]_ ax z|c[es]_ ax z|z[es]_ ax z|g[es]_ ax z|x[es]_ ax z|h[es]_ ax z|S[es]_ z
S[e]_|S[e]ly_|S[e]ment|S[e]ful|S[e]less|S[e]ness|[e]_ iy
[earl]y ih r l|_[early] er l iy|[ears]_ ih r z|[eared]_ ih r d|[ear]C er|[ear] ih r|[eard] er d|[ead] eh d|[eath]er eh dh|[eath]_ eh th|[ealth] eh l th|[easure] eh zh axr|[ea] iy|[ee] iy|[eer] ih r
[eigh] ey|c[ei] iy|[ein] ey n|[ei] iy|[ew] uw|[eu] y uw|S[ey]_ iy|S[eys]_ iy z|[ey] ey|[eous] iy ax s|[eo] iy ax
[ere]_ ih r|[err] eh r|S[er] axr|[er]V eh r|[er] er|[e]Ce_ iy|[e]Ces_ iy
_[be]CV b ih|_[bet]we b ih t|S[ment]_ m ax n t|S[ments]_ m ax n t s|_[emo] ih m ow|_[eve]nt ih v eh|[every] eh v r iy|[engine] eh n jh ax n|_[de]CV d ih|_[re]CV r ih|_[pre]C p r ih|[est]_ eh s t|S[et]_ ax t|S[ety]_ ax t iy
S[en]_ ax n|S[ens]_ ax n z|S[ened]_ ax n d|S[ent]_ ax n t|S[ence]_ ax n s|S[el]_ ax l|S[ess]_ ax s|S[em]_ ax m|[é] ey|[e]o iy|[e]a iy|_[e]xC ih|[e] eh
[f] f
[nging]_ ng ih ng|a[ng]e n jh|[nge] n jh|[ngth] ng th|[ng]_ ng|[ngs]_ ng z|[nges]_ n jh ax z|[nged]_ ng d|[ng]V ng g|[ngl] ng g l|[ngr] ng g r|[ng] ng
_[gn] n|[gn]_ n|[gh]_|_[gh] g|[gh]|[gue]_ g|[gu]a g w|[gu]V g|[gg] g|_[gir] g er|_[gi]v g ih|fin[ger] g axr|[g]F jh|[g] g
_[h] hh|V[h]_|V[h]C|[rh] r|[kh] k|[h] hh
_[i]_ ay|[igh] ay|[ign]_ ay n|[ildren] ih l d r ax n|[ild]_ ay l d|[ind]_ ay n d|[inds]_ ay n d z|[ind]ing ay n d|[iew] y uw|[ique] iy k
[ire]_ ay axr|[irred]_ er d|[irr] ih r|[ir]V ay r|[ir] er|S[ied]_ iy d|[ied]_ ay d|S[ies]_ iy z|[ies]_ ay z|S[ie]_ iy|[ie]_ ay|[ier]_ iy axr|[iest]_ iy ax s t
[iet] ay ax t|[ie] iy|[ious] iy ax s|[ium] iy ax m|_C[i]a ay|_C[i]o ay|[ia]_ iy ax|[ia] iy ax|[io] iy ow|S[ion]_ y ax n
S[it]_ ax t|S[its]_ ax t s|S[is]_ ax s|S[ity]_ ax t iy|S[ities]_ ax t iy z|[time] t ay m|[line] l ay n|[i]nal ay|S[ive]_ ih v|S[ice]_ ax s|S[ine]_ ih n|[iv]ing ih v|_t[i]ny ay|[i]C% ay|[i]Cle_ ay|[ing]_ ih ng|[i]_ iy|[i] ih
[j] jh|_[kn] n|_[key] k iy|[k] k
l[led]_ l d|w[led]_ l d|r[led]_ l d|C[le]_ ax l|C[led]_ ax l d|C[les]_ ax l z|[l] l
[mb]_ m|[mbs]_ m z|[mbed]_ m d|[mbing]_ m ih ng|[mn]_ m|[m] m|[n]k ng|[n]x ng|[n]q ng|[n]cl ng|[nction] ng k sh ax n|[nct] ng k t|[n] n
[ought] ao t|[ough]_ ow|[ould] uh d|[oulder] ow l d axr|[oung] ah ng|[oup] uw p|[oubl] ah b ax l|[ousin] ah z ax n|[ous]_ ax s|[ously]_ ax s l iy
c[our] ao r|_[your] y ao r|[ourn] er n|S[our]_ axr|[our] aw axr|_[you] y uw|[ou] aw
[ow]_ ow|[owed]_ ow d|[ows]_ ow z|[owing]_ ow ih ng|[ow] aw|[oor] ao r|[oo] uw|[oar] ao r|[oa] ow|[oe]_ ow|[oes]_ ow z|[oi] oy|[oy] oy
w[or] er|S[or]_ axr|S[ors]_ axr z|[orr] aa r|[or] ao r|[other] ah dh axr|[othing] ah th ih ng|[oth] ao th
[some] s ah m|[come]_ k ah m|[comes]_ k ah m z|[coming]_ k ah m ih ng|[love] l ah v|[loving] l ah v ih ng|[above] ax b ah v|[move] m uw v|[prove] p r uw v|c[over] ah v axr|gl[ove] ah v
[omb]_ ow m|[old] ow l d|[olled]_ ow l d|[oll]_ ow l|[olk] ow k|[olt] ow l t|[ong] ao ng|[oss] ao s|[ost] ao s t|[off] ao f|[oft] ao f t|[og]_ ao g
_[con]C k ax n|_[com]p k ax m|S[om]_ ax m|S[on]_ ax n|S[ons]_ ax n z|S[ond]_ ax n d|S[onds]_ ax n d z|[control] k ax n t r ow l|[ource] ao r s|[house] hh aw s|_[open] ow p ax n
[o]C% ow|[o]Cen_ ow|_[oh]_ ow|[o]_ ow|[o]'_ ow|[o]V ow|[o]CiV ow|_C[o]Ca ow|_C[o]Ce ow|S[o]CV ax|[o] aa
[ph] f|_[ps] s|_[pn] n|[p] p|[que]_ k|[qu] k w|[q] k|_[wr] r|'[re]_ axr|[r] r
V[sion] zh ax n|[ssion] sh ax n|[sion] sh ax n|V[sure] zh axr|[ssure] sh axr|[sh] sh|[stle] s ax l|S[sten]_ s ax n|S[stened]_ s ax n d|[stion] s ch ax n|s'[s]_|[s] s
[tion] sh ax n|[tial] sh ax l|[tient] sh ax n t|[tious] sh ax s|[ture] ch axr|[tured]_ ch axr d|[tu]V ch uw|[thm] dh ax m|[th] th|[t] t
_p[ull] uh l|_b[ull] uh l|f[ull] uh l|p[ulled]_ uh l d|p[ulling]_ uh l ih ng|p[ush] uh sh|p[u]t_ uh|S[ful] f ax l|[uild] ih l d|[uilt] ih l t|[uy] ay|c[ue] y uw|[value] v ae l y uw|[ue]_ uw|[ues]_ uw z|[ued]_ uw d|[ui] uw|[urr] er
[ure]_ y uh r|[ur]V uh r|[ur] er|_[uni] y uw n ax|_[u]C% y uw|_[u]s y uw|_[un] ah n|_[us]_ ah s
m[u]CV y uw|f[u]CV y uw|h[u]CV y uw|c[u]CV y uw|p[u]CV y uw|S[u]CV y ax|[u]C% uw|[u]CV uw|[u]_ uw|[ua] uw ax|S[um]_ ax m|S[us]_ ax s|[u] ah
[v] v|'[ve]_ v|_[who] hh uw|[wh] w|[where] w eh r|[answer] ae n s axr|[w] w|_[x] z|[x] k s
_[y]V y|S[y]ing_ iy|[y]ing_ ay|S[y]_ iy|[y]_ ay|[y]C% ay|[y]V y|[y] ih|[z] z
[0] z ih r ow|[1] w ah n|[2] t uw|[3] th r iy|[4] f ao r|[5] f ay v|[6] s ih k s|[7] s eh v ax n|[8] ey t|[9] n ay n
[&] ae n d|[%] p er s eh n t|[+] p l ah s|[=] iy k w ax l z|[@] ae t|[$] d aa l axr|[€] y uh r ow|[£] p aw n d|[°] d ih g r iy
";
