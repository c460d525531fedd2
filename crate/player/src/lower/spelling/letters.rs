//! Letters of other languages, each by its own value, and letters with marks.

/// Letters of the Latin, the Greek and the Cyrillic alphabet, for languages without rules and for
/// letters without a rule in their language. Digits are spoken in English.
pub(super) const RULES: &str = "
[a] aa|[b] b|[ch] ch|[c]F s|[c] k|[d] d|[e] eh|[f] f|[g] g|[h] hh|[i] iy|[j] y|[k] k|[l] l|[m] m|[n] n|[o] ao|[ou] uw|[ph] f|[p] p|[qu] k w|[q] k
[r] r|[sh] sh|[s] s|[t] t|[u] uw|[v] v|[w] v|[x] k s|[y] iy|[z] z|[ä] eh|[ö] uw|[ü] uw|[ã] ah|[õ] ao|[ç] s|[ß] s
[æ] eh|[ø] uw|[œ] uw|[þ] th|[ð] dh|[ł] w|[đ] d|[ı] ih|[ŋ] ng|[ə] ax
[α] aa|[β] v|[γ] g|[δ] dh|[ε] eh|[ζ] z|[η] iy|[θ] th|[ι] iy|[κ] k|[λ] l|[μ] m|[ν] n|[ξ] k s|[ο] ao|[π] p|[ρ] r|[σ] s|[ς] s|[τ] t|[υ] iy|[φ] f|[χ] k
[ψ] p s|[ω] ao|[ου] uw|[αι] eh|[ει] iy|[οι] iy|[μπ] b|[ντ] d|[ά] aa|[έ] eh|[ή] iy|[ί] iy|[ό] ao|[ύ] iy|[ώ] ao|[ού] uw
[а] aa|[б] b|[в] v|[г] g|[д] d|[е] y eh|[ё] y ao|[ж] zh|[з] z|[и] iy|[й] y|[к] k|[л] l|[м] m|[н] n|[о] ao|[п] p|[р] r|[с] s|[т] t|[у] uw|[ф] f|[х] k
[ц] t s|[ч] ch|[ш] sh|[щ] sh|[ъ]|[ы] ih|[ь]|[э] eh|[ю] y uw|[я] y aa|[і] iy|[ї] y iy|[є] y eh|[ґ] g|[ў] w|[ј] y|[љ] l|[њ] n|[џ] jh|[ђ] jh|[ћ] ch
[0] z ih r ow|[1] w ah n|[2] t uw|[3] th r iy|[4] f ao r|[5] f ay v|[6] s ih k s|[7] s eh v ax n|[8] ey t|[9] n ay n
";

/// Letters with marks, behind the letter that they are.
const MARKED: &str = "aàáâãäåāăą cçćčĉċ dď eèéêëēėęě gğĝģġ hĥ iìíîïīįĩ jĵ kķ lĺľļ nñńňņ oòóôõöōőŏ rŕřŗ sśšşșŝ tťţț \
     uùúûüūůűųŭũ wŵ yýÿŷ zźżž";

/// Returns a letter without its diacritical marks.
pub(super) fn bare(letter: char) -> char {
    if letter.is_ascii() {
        return letter;
    }
    let group = MARKED.split(' ').find(|group| group.contains(letter));
    group.and_then(|g| g.chars().next()).unwrap_or(letter)
}

/// Returns the precomposed letter for a letter and a combining mark, if spelling rules use it;
/// otherwise `None`.
pub(super) fn composed(letter: char, mark: char) -> Option<char> {
    const MADE: [(char, &str, &str); 6] = [
        ('\u{300}', "a", "à"),
        ('\u{301}', "aeiou", "áéíóú"),
        ('\u{302}', "aeo", "âêô"),
        ('\u{303}', "ao", "ãõ"),
        ('\u{308}', "aou", "äöü"),
        ('\u{327}', "c", "ç"),
    ];
    let (_, bare, made) = MADE.into_iter().find(|(m, ..)| *m == mark)?;
    made.chars().nth(bare.chars().position(|c| c == letter)?)
}
