//! German rules. The letters are those of the official orthography; long *e* and *o* are as close
//! as their lips, and *r* counts as a vowel unless a vowel follows.

/// Words that no rule would find, with their phones.
pub(super) const WORDS: &str = "
er ih ah|der d ih ah|dem d ih m|den d ih n|wer v ih ah|wem v ih m|wen v ih n|es eh s|so z uw|wo v uw|vom f ao m|von f ao n|zum s uh m|zur s uh ah
vor f uw ah|vase v aa z ax|obst uw p s t|erst ih ah s t|erste ih ah s t ax|mond m uw n t|hoch hh uw k|los l uw s|tot t uw t|schon sh uw n
am aa m|im ih m|um uh m|gehört g ax hh uw ah t|gestern g eh s t ah n|bis b ih s|computer k ao m p y uw t ah|baby b ey b iy|okay ao k ey
";

/// Letter-to-sound rules of German.
pub(super) const RULES: &str = "
[aa] aa|[ah] aa|[ai] ay|[ay] ay|[au] aw|[äu] oy|[ä] eh|[a] aa
[b] b|[chs] k s|a[ch] k|o[ch] k|u[ch] k|_[ch]C k|_[cha] k aa|_[cho] k ao|[ch] y|[ck] k|[c]F s|[c] k|[dt] t|[d] d
[ei] ay|[eih] ay|[ey] ay|[eu] oy|[ee] ih|[eh]V ih|m[ehr] ih ah|[eh] ih|S[er]_ ah|S[ern]_ ah n|S[ers]_ ah s|S[ert]_ ah t|S[er]C ah|_[er]C eh ah|_[ver] f ah|_[pfer]d p ih ah|_[zer] s ah
S[e]_ ax|S[en]_ ax n|S[ens]_ ax n s|S[end]_ ax n t|S[el]_ ax l|S[eln]_ ax l n|S[em]_ ax m|S[es]_ ax s|S[et]_ ax t|S[est]_ ax s t|S[e]ne ax|S[e]nd ax|S[e]te ax
_[ge]C g ax|_[geb]e g ih b|_[gel]b g eh l|_[gel]d g eh l|_[ges]t_ g eh s|_[geg] g ih g|_[gern] g eh ah n|_[be]CV b ax|_[bes]C b ax sh|_[best]_ b eh s t|_[beste] b eh s t ax|_[bet]t b eh t
[e]CV ih|[e]_ ih|[e] eh
[f] f|[g]_ k|[ig]_ ih y|[g] g|_[h] hh|[heit] hh ay t|[haft] hh aa f t|[haus] hh aw s|[hin] hh ih n|[her]_ hh ih ah|C[h] hh|_ge[h]ö hh|_be[h]a hh|wo[h]er hh|wo[h]in hh|V[h]|[h] hh
[ieh] iy|[ie] iy|[ih] iy|[ien]_ y ax n|[i] ih|[j] y|[k] k|[l] l|[m] m|[ng] ng|[n]k ng|[n] n
[oh] uw|[oo] uw|[o]CV uw|[o]_ uw|[o]ß uw|[brot] b k uw t|[öh] uw|[ö]CV uw|[ö]h uw|[ö]ß uw|[ö]n_ uw|[ö]_ uw|[ö] ao|[o] ao
[pf] p|[ph] f|[p] p|[qu] k v|V[r]C k|V[r]_ ah|[rh] k|[r] k
[sch] sh|_[sp] sh p|_[st] sh t|_ver[st] sh t|_ge[st] sh t|_auf[st] sh t|_an[st] sh t|_ent[st] sh t|_aus[st] sh t|_ver[sp] sh p|_ge[sp] sh p|[s] z|[ß] s
[tion] s y uw n|[tsch] ch|[tz] s|[th] t|[t] t|[uh] uw|[üh] uw|[ü] uw|[u] uh
[v] f|[w] v|[x] k s|_[y]V y|[y] uw|[z] s
[0] n uh l|[1] ay n s|[2] s v ay|[3] d k ay|[4] f iy ah|[5] f uw n f|[6] z eh k s|[7] z iy b ax n|[8] aa k t|[9] n oy n
[&] uh n t|[%] p k ao t s eh n t|[+] p l uh s|[=] g l ay y|[@] eh t|[$] d ao l aa|[€] oy k uw|[£] p f uh n t|[°] g k aa t
";
