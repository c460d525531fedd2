//! Phone symbols of German and Portuguese, and the table rows of their lip shapes.
//!
//! One text per language, one triple per line: SAMPA symbol, espeak-ng's mnemonic (`-`: none), and
//! the SAMPA symbol of the row. A text takes a quarter of the space of a table of strings, and a
//! page downloads it. Phones with the same name in English are not repeated. Rows differ from their
//! language's phone in properties that lips do not show: voice, nasality, length. Front rounded
//! vowels have the lips of `u:` and `U` (F&H section 3.1.3 has no tongue for them either), ç those
//! of j, a uvular r those of a velar, ɐ those of ʌ. Sources: espeak-ng's `docs/languages`, MARY's
//! German SAMPA, and the observed mnemonics of espeak-ng 1.51.

/// Variants that espeak-ng has of English phones, and marks that it has in every language:
/// glottal onset (`_!`, `_|`), palatal off-glide (`;`).
pub(super) const ENGLISH: &str = "\
- @2 @
- @- @
- 3: 3:
- a# @
- a2 {
- aa {
- A@ A:
- A# A:
- 02 Q
- O@ O:
- O2 O:
- o@ O:
- I2 I
- i i:
- i@ I@
- E2 e
- E@ e@
- aI3 aI
- aI@ aI
- aU@ aU
- e e
- u u:
- r- r
- z# z
- d# d
- A~ A:
- O~ O:
- w# w
- l# l
- l- l=
- ; j
- _! ?
- _| ?
- _ _
- _:: _
- N- N
- tS; tS
- dZ; dZ
";

/// German.
pub(super) const GERMAN: &str = "\
a a A:
a: A: A:
- A A:
E E e
E: E: e
e: e: I
e e e
i: i: i:
i i i:
O O o
o: o: u:
o o o
u: u: u:
u u u:
9 W o
- W~ o
2: Y: u:
2 Y u:
Y y U
y: y: u:
y - u:
6 3 V
aI aI aI
aU aU aU
OY OY OI
- UR U@
C C j
x x k
R r k
- R k
- r- k
pf pF p
ts ts s
- E~ e
- O~ o
- A~ A:
- @- @
- aI3 aI
";

/// Portuguese.
pub(super) const PORTUGUESE: &str = "\
a a A:
- A A:
6 & V
- &/ V
e e e
E E e
i i i:
1 y 1
- i/ 1
O O o
u u u:
6~ &~ V
e~ e~ e
i~ i~ i:
o~ o~ o
u~ u~ u:
aj aI aI
ej eI eI
oj oI OI
aw aU aU
ow oU @U
6~w~ &U~ aU
- &~U~ aU
- &I~ aI
o~j~ oI~ OI
e~j~ eI~ eI
- OI OI
- EI eI
- EU ew
- OU @U
4 * 4
- r- 4
- r r
- R 4
R x k
J n^ n
L l^ l
5 l/ l
G Q\" k
- s# S
- @- @
X - k
";

/// Returns the SAMPA symbol of the table row for a symbol of a language; `column` as in
/// [`super::PhoneTargets`] (1 SAMPA, 2 espeak-ng).
pub(super) fn sampa(language: &'static str, column: usize, symbol: &str) -> Option<&'static str> {
    let mut words = language.split_ascii_whitespace();
    while let (Some(sampa), Some(espeak), Some(row)) = (words.next(), words.next(), words.next()) {
        let name = if column == 1 { sampa } else { espeak };
        if name == symbol && name != "-" {
            return Some(row);
        }
    }
    None
}
