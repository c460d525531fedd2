//! Portuguese rules. The letters are those of the *Acordo Ortográfico* of 1990; weak vowels and
//! final *s* are European, and [`BRAZIL`] contains the Brazilian differences.

/// Words that no rule would find, with their phones.
pub(super) const WORDS: &str = "
e iy|o uh|os uh sh|a ah|as ah sh|ao aw|aos aw sh|um uw|uns uw sh|muito m uw iy t uh|muita m uw iy t ah|que k ix|quem k ey|porque p uh dx k ix|foi f oy
eu eh w|ou ow|mãe m ay|pela p ix l ah|pelo p ix l uh|por p uh dx|cinquenta s iy k w eh t ah
";

/// Letter-to-sound rules of Portuguese. The stress is on one of the last two syllables; a vowel
/// before `T` is weak.
pub(super) const RULES: &str = "
[ão] aw|[ãe] ay|[ã] ah|[am]_ aw|[á] aa|[à] aa|[â] ah|[ai] ay|[ái] ay|[au] aw|[a] aa
[b] b|[ch] sh|[c]F s|[ç] s|[cç] s|[cc]F s|[c] k|[d] d
[em]_ ey ng|[ens]_ ey sh|[ém]_ ey ng|[éns]_ ey sh|[êm]_ ey|[ei] ey|[éi] ey|[eu] eh w|[éu] eh w|[é] eh|[ê] eh
[e]_ ix|[es]_ ix sh|_[e]T iy|_[em]C ey m|_[en] ey ng|_[es]C ix sh|[e]nT eh|[e]mT eh|[ea] y aa|[eo] y ao|[e]T ix|[e] eh
[f] f|[gu]F g|[gu]a g w|[g]F zh|[g] g|[h]|[í] iy|[iu] iy w|_C[i]a_ iy|_C[i]as_ iy|[i]a y|[i]o y|[i]e y|[i] iy|[j] zh|[k] k|[lh] l|[l] l
V[m]_|[m] m|[nh] n|V[n]C ng|V[n]_|[n] n
[õe] oy|[õ] ao|[ó] ao|[ô] ao|[oi] oy|[ói] oy|[ou] ow|[oa]_ uh ah|[o]_ uh|[os]_ uh sh|[o]nT ao|[o]mT ao|[oso]_ ao z uh|[o]T uh|[o] ao
[ph] f|[p] p|[qu]F k|[qu] k w|[q] k|[rr] k|_[r] k|V[r]C dx ax|n[r] k|l[r] k|[r] dx
[ss] s|[sc]F s|V[s]V z|[s]_ sh|[s]C sh|[sh] sh|[s] s|[th] t|[t] t
[ú] uw|[ui] uw iy|_C[u]a uw|[u]a w|[u]e w|[u]o w|[u] uw|[v] v|[w] w|_e[x]V z|[x] sh|[y] iy|[z]_ sh|[z] z
[0] z eh dx uh|[1] uw|[2] d oy sh|[3] t dx eh sh|[4] k w aa t dx uh|[5] s iy k uh|[6] s ey sh|[7] s eh t ix|[8] oy t uh|[9] n ao v ix
[&] iy|[%] p uh dx s eh t uh|[+] m ay sh|[=] iy g w aa l|[@] ah dx ao b ah|[$] d ao l ah dx|[€] eh w dx uh|[£] l iy b dx ah|[°] g dx aw sh
";

/// Brazilian exceptions to the rules.
pub(super) const BRAZIL: &str = "
[s]_ s|[s]C s|[es]_ iy s|_[es]C iy s|[os]_ uh s|[z]_ s|[e]_ iy|[ens]_ ey s|[éns]_ ey s|[te]_ ch iy|[de]_ jh iy|[ti] ch iy|[di] jh iy|V[l]C w|V[l]_ w|[r]_ hh
[e]T eh|[o]T ao
";
