//! Pronunciations in the International Phonetic Alphabet, from authors in each engine's own phones,
//! and from aligners' phone names.
//!
//! The names are facts of Festival's `radio_phones.scm` and `mrpa_phones.scm`, of SAMPA and of
//! espeak-ng's mnemonics (its `docs/phonemes.md`). A phone that a set lacks is replaced with its
//! nearest one; the nearest phones are *designed*.

use anyhow::{Result, bail, ensure};
use raconteur_speech::phones::{self, Class};

/// Longest pronunciation that is read, in characters.
const MAX_CHARACTERS: usize = 200;

/// Phone set of an engine, to which IPA pronunciations are converted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Set {
    /// Festival's and flite's American English.
    Radio,
    /// Festival's British English.
    Mrpa,
    /// MARY.
    Sampa,
    /// espeak-ng's English.
    Espeak,
    /// espeak-ng's German.
    EspeakDe,
    /// espeak-ng's Portuguese.
    EspeakPt,
}

/// Syllable of an IPA pronunciation, converted to an engine's phones.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Syllable {
    /// Stress: 0 none, 1 primary, 2 secondary.
    pub(super) stress: u8,
    /// Phones in the engine's set.
    pub(super) phones: Vec<&'static str>,
}

/// Sonority, which determines syllables.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sonority {
    Stop,
    Fricative,
    Nasal,
    Liquid,
    Glide,
    Vowel,
}

use Sonority::{Fricative, Glide, Liquid, Nasal, Stop, Vowel};

struct Row {
    ipa: &'static str,
    sonority: Sonority,
    /// Name in each [`Set`]; several phones are separated by spaces.
    names: [&'static str; 6],
}

const fn row(ipa: &'static str, sonority: Sonority, names: [&'static str; 6]) -> Row {
    Row {
        ipa,
        sonority,
        names,
    }
}

/// Radio, MRPA, SAMPA, espeak-ng's English, German and Portuguese.
#[rustfmt::skip]
static TABLE: [Row; 110] = [
    row("ɑː", Vowel, ["aa", "aa", "A:", "A:", "A:", "a"]),
    row("ɑ", Vowel, ["aa", "aa", "A", "A:", "A:", "a"]),
    row("ɑ̃", Vowel, ["aa n", "aa n", "A~", "A~", "A~", "&~"]),
    row("aː", Vowel, ["aa", "aa", "a:", "A:", "A:", "a"]),
    row("a", Vowel, ["aa", "a", "a", "a", "a", "a"]),
    row("æ", Vowel, ["ae", "a", "{", "a", "E", "a"]),
    row("ʌ", Vowel, ["ah", "uh", "V", "V", "a", "&"]),
    row("ɐ", Vowel, ["ax", "@", "6", "V", "3", "&"]),
    row("ɐ̃", Vowel, ["ah n", "uh n", "6~", "V n", "a n", "&~"]),
    row("ɐ̯", Vowel, ["ax", "@", "6", "3", "3", "&"]),
    row("ə", Vowel, ["ax", "@", "@", "@", "@", "y"]),
    row("ɘ", Vowel, ["ax", "@", "@", "@", "@", "y"]),
    row("ᵻ", Vowel, ["ih", "i", "1", "I#", "I", "y"]),
    row("ɨ", Vowel, ["ih", "i", "1", "I2", "I", "y"]),
    row("ɔː", Vowel, ["ao", "oo", "O:", "O:", "O", "O"]),
    row("ɔ", Vowel, ["ao", "o", "O", "O:", "O", "O"]),
    row("ɔ̃", Vowel, ["ao n", "o n", "O~", "O~", "O~", "o~"]),
    row("ɒ", Vowel, ["aa", "o", "Q", "0", "O", "O"]),
    row("ɛː", Vowel, ["eh", "e@", "E:", "e@", "E:", "E"]),
    row("ɛ", Vowel, ["eh", "e", "E", "E", "E", "E"]),
    row("ɛ̃", Vowel, ["ae n", "a n", "E~", "a n", "E~", "e~"]),
    row("ɜː", Vowel, ["er", "@@", "3:", "3:", "W", "e"]),
    row("ɜ", Vowel, ["er", "@@", "3", "3:", "W", "e"]),
    row("ɝ", Vowel, ["er", "@@ r", "3r", "3:", "W", "e *"]),
    row("ɚ", Vowel, ["er", "@ r", "@r", "3", "3", "& *"]),
    row("eː", Vowel, ["ey", "ei", "e:", "eI", "e:", "e"]),
    row("e", Vowel, ["ey", "e", "e", "E", "e:", "e"]),
    row("ẽ", Vowel, ["eh n", "e n", "e~", "E n", "e: n", "e~"]),
    row("iː", Vowel, ["iy", "ii", "i:", "i:", "i:", "i"]),
    row("i", Vowel, ["iy", "ii", "i", "i:", "i:", "i"]),
    row("ĩ", Vowel, ["iy n", "ii n", "i~", "i: n", "i: n", "i~"]),
    row("ɪ", Vowel, ["ih", "i", "I", "I", "I", "i"]),
    row("ʊ", Vowel, ["uh", "u", "U", "U", "U", "u"]),
    row("uː", Vowel, ["uw", "uu", "u:", "u:", "u:", "u"]),
    row("u", Vowel, ["uw", "uu", "u", "u:", "u:", "u"]),
    row("ũ", Vowel, ["uw n", "uu n", "u~", "u: n", "u: n", "u~"]),
    row("oː", Vowel, ["ow", "ou", "o:", "oU", "o:", "o"]),
    row("o", Vowel, ["ow", "ou", "o", "oU", "o:", "o"]),
    row("õ", Vowel, ["ow n", "ou n", "o~", "oU n", "O n", "o~"]),
    row("œ", Vowel, ["er", "@@", "9", "3:", "W", "e"]),
    row("øː", Vowel, ["er", "@@", "2:", "3:", "Y:", "e"]),
    row("ø", Vowel, ["er", "@@", "2", "3:", "Y:", "e"]),
    row("ʏ", Vowel, ["ih", "i", "Y", "I", "y", "i"]),
    row("yː", Vowel, ["uw", "uu", "y:", "u:", "y:", "i"]),
    row("y", Vowel, ["uw", "uu", "y", "u:", "y:", "i"]),
    row("eɪ", Vowel, ["ey", "ei", "EI", "eI", "E I", "eI"]),
    row("ej", Vowel, ["ey", "ei", "EI", "eI", "E I", "eI"]),
    row("aɪ", Vowel, ["ay", "ai", "aI", "aI", "aI", "aI"]),
    row("aj", Vowel, ["ay", "ai", "aI", "aI", "aI", "aI"]),
    row("aʊ", Vowel, ["aw", "au", "aU", "aU", "aU", "aU"]),
    row("aw", Vowel, ["aw", "au", "aU", "aU", "aU", "aU"]),
    row("oʊ", Vowel, ["ow", "ou", "@U", "oU", "o:", "oU"]),
    row("əʊ", Vowel, ["ow", "ou", "@U", "oU", "o:", "oU"]),
    row("ow", Vowel, ["ow", "ou", "@U", "oU", "o:", "oU"]),
    row("əw", Vowel, ["ow", "ou", "@U", "oU", "o:", "oU"]),
    row("ɔj", Vowel, ["oy", "oi", "OI", "OI", "OY", "OI"]),
    row("ɔɪ", Vowel, ["oy", "oi", "OI", "OI", "OY", "OI"]),
    row("ɔʏ", Vowel, ["oy", "oi", "OY", "OI", "OY", "OI"]),
    row("oj", Vowel, ["oy", "oi", "OI", "OI", "OY", "oI"]),
    row("ɪə", Vowel, ["ih r", "i@", "I@", "i@3", "i:3", "i &"]),
    row("ɛə", Vowel, ["eh r", "e@", "E@", "e@", "E3", "E &"]),
    row("eə", Vowel, ["eh r", "e@", "E@", "e@", "E3", "E &"]),
    row("ʊə", Vowel, ["uh r", "u@", "U@", "U@", "u:3", "u &"]),
    row("uj", Vowel, ["uw iy", "uu ii", "uj", "u: I", "U I", "uI"]),
    row("ew", Vowel, ["eh uw", "e uu", "ew", "E U", "E U", "eU"]),
    row("iw", Vowel, ["iy uw", "ii uu", "iw", "i: U", "i: U", "iU"]),
    row("ɐ̃w̃", Vowel, ["aw n", "au n", "6~w~", "aU n", "aU n", "&~U~"]),
    row("ɐ̃ʊ̃", Vowel, ["aw n", "au n", "6~w~", "aU n", "aU n", "&~U~"]),
    row("õj̃", Vowel, ["oy n", "oi n", "o~j~", "OI n", "OY n", "oI~"]),
    row("õɪ̃", Vowel, ["oy n", "oi n", "o~j~", "OI n", "OY n", "oI~"]),
    row("p", Stop, ["p", "p", "p", "p", "p", "p"]),
    row("b", Stop, ["b", "b", "b", "b", "b", "b"]),
    row("t", Stop, ["t", "t", "t", "t", "t", "t"]),
    row("d", Stop, ["d", "d", "d", "d", "d", "d"]),
    row("k", Stop, ["k", "k", "k", "k", "k", "k"]),
    row("c", Stop, ["k", "k", "c", "k", "k", "k"]),
    row("ɡ", Stop, ["g", "g", "g", "g", "g", "g"]),
    row("ʔ", Stop, ["", "", "?", "?", "?", ""]),
    row("tʃ", Stop, ["ch", "ch", "tS", "tS", "tS", "tS"]),
    row("dʒ", Stop, ["jh", "jh", "dZ", "dZ", "dZ", "dZ"]),
    row("pf", Stop, ["p f", "p f", "pf", "p f", "pF", "p f"]),
    row("ts", Stop, ["t s", "t s", "ts", "t s", "ts", "t s"]),
    row("f", Fricative, ["f", "f", "f", "f", "f", "f"]),
    row("v", Fricative, ["v", "v", "v", "v", "v", "v"]),
    row("θ", Fricative, ["th", "th", "T", "T", "s", "s"]),
    row("ð", Fricative, ["dh", "dh", "D", "D", "z", "d"]),
    row("s", Fricative, ["s", "s", "s", "s", "s", "s"]),
    row("z", Fricative, ["z", "z", "z", "z", "z", "z"]),
    row("ʃ", Fricative, ["sh", "sh", "S", "S", "S", "S"]),
    row("ʒ", Fricative, ["zh", "zh", "Z", "Z", "Z", "Z"]),
    row("ç", Fricative, ["sh", "sh", "C", "S", "C", "S"]),
    row("x", Fricative, ["hh", "h", "x", "x", "x", "x"]),
    row("χ", Fricative, ["hh", "h", "x", "x", "x", "x"]),
    row("h", Fricative, ["hh", "h", "h", "h", "h", "x"]),
    row("ɦ", Fricative, ["hh", "h", "h", "h", "h", "x"]),
    row("ɣ", Fricative, ["g", "g", "G", "g", "g", "g"]),
    row("β", Fricative, ["b", "b", "B", "b", "b", "b"]),
    row("m", Nasal, ["m", "m", "m", "m", "m", "m"]),
    row("n", Nasal, ["n", "n", "n", "n", "n", "n"]),
    row("ŋ", Nasal, ["ng", "ng", "N", "N", "N", "n"]),
    row("ɲ", Nasal, ["n y", "n y", "J", "n j", "n j", "n^"]),
    row("l", Liquid, ["l", "l", "l", "l", "l", "l"]),
    row("ɫ", Liquid, ["l", "l", "5", "l", "l", "l/"]),
    row("ʎ", Liquid, ["l y", "l y", "L", "l j", "l j", "l^"]),
    row("ɹ", Liquid, ["r", "r", "r", "r", "r", "*"]),
    row("ɾ", Liquid, ["dx", "t", "4", "t#", "r", "*"]),
    row("ʁ", Liquid, ["r", "r", "R", "r", "r", "x"]),
    row("j", Glide, ["y", "y", "j", "j", "j", "j"]),
    row("ɥ", Glide, ["y", "y", "H", "j", "j", "j"]),
    row("w", Glide, ["w", "w", "w", "w", "v", "w"]),
];

/// Syllabic consonants: a short vowel and the consonant.
const SYLLABIC: char = '\u{329}';

/// Ignored marks, too fine for any engine: ties, breath, release, half length, tones, exact tongue
/// position, and non-syllabic vowels.
const IGNORED: &str = "\u{361}\u{35c}ʰʱʲˠˤʷˑˀⁿˡ˥˦˧˨˩˞\u{306}\u{308}\u{30a}\u{318}\u{319}\u{31a}\u{31c}\u{31d}\
    \u{31e}\u{31f}\u{320}\u{324}\u{325}\u{32a}\u{32c}\u{32f}\u{330}\u{339}\u{33a}\u{33b}\u{33c}";

/// Nasalisation mark of vowels; the table contains the nasal vowels that engines have.
const NASAL: char = '\u{303}';

/// Returns replacements for variant letters, including composed ones, and the nearest equivalents
/// of those not in the table. The choice of the nearest, by position of lips and jaw, is
/// *designed*.
fn replaced(c: char) -> &'static [char] {
    match c {
        '\u{30d}' => &[SYLLABIC],
        'ʉ' | 'ᵿ' => &['u'],
        'ɯ' => &['ɨ'],
        'ɤ' => &['ʌ'],
        'ɵ' => &['ø'],
        'ɞ' | 'ɶ' => &['œ'],
        'ɓ' | 'ʙ' => &['b'],
        'ɗ' | 'ɖ' => &['d'],
        'ʈ' => &['t'],
        'ɟ' | 'ɠ' | 'ɢ' => &['ɡ'],
        'q' => &['k'],
        'ʕ' => &['ʔ'],
        'ɸ' => &['f'],
        'ʋ' | 'ⱱ' => &['v'],
        'ɕ' | 'ʂ' | 'ɧ' => &['ʃ'],
        'ʑ' | 'ʐ' => &['ʒ'],
        'ʝ' => &['j'],
        'ħ' => &['h'],
        'ɰ' => &['ɣ'],
        'ɱ' => &['m'],
        'ɳ' => &['n'],
        'ɴ' => &['ŋ'],
        'ɬ' | 'ɮ' | 'ɭ' | 'ɺ' | 'ʟ' => &['l'],
        'ɽ' => &['ɾ'],
        'ʍ' => &['w'],
        'ʨ' => &['t', 'ʃ'],
        'ʥ' => &['d', 'ʒ'],
        'g' => &['ɡ'],
        ':' => &['ː'],
        'r' | 'ɻ' => &['ɹ'],
        'ʀ' => &['ʁ'],
        'ʦ' => &['t', 's'],
        'ʧ' => &['t', 'ʃ'],
        'ʤ' => &['d', 'ʒ'],
        'ã' => &['ɐ', '\u{303}'],
        'ẽ' => &['e', '\u{303}'],
        'ĩ' => &['i', '\u{303}'],
        'õ' => &['o', '\u{303}'],
        'ũ' => &['u', '\u{303}'],
        _ => &[],
    }
}

enum IpaSymbol {
    Phone(&'static Row),
    Stress(u8),
    Dot,
}

/// Parses a pronunciation. Stress marks, dots and spaces separate syllables; otherwise each
/// syllable gets the maximal onset.
///
/// # Errors
/// Returns an error if a character is not a phone of the table, if there is no vowel, or if the
/// pronunciation is longer than 200 characters.
pub(super) fn syllables(ipa: &str, set: Set) -> Result<Vec<Syllable>> {
    // The groups between marks.
    let mut groups: Vec<(u8, Vec<&Row>)> = vec![(0, Vec::new())];
    for piece in pieces(ipa)? {
        let stress = match piece {
            IpaSymbol::Phone(row) => {
                if let Some((_, rows)) = groups.last_mut() {
                    rows.push(row);
                }
                continue;
            }
            IpaSymbol::Stress(stress) => stress,
            IpaSymbol::Dot => 0,
        };
        match groups.last_mut() {
            // Consonants alone form no syllable; they join the next vowel.
            Some(last) if !last.1.iter().any(|r| r.sonority == Vowel) => {
                last.0 = last.0.max(stress);
            }
            _ => groups.push((stress, Vec::new())),
        }
    }
    if let Some((_, rest)) = groups.pop_if(|g| !g.1.iter().any(|r| r.sonority == Vowel)) {
        match groups.last_mut() {
            Some((_, last)) => last.extend(rest),
            None => bail!("the pronunciation {ipa:?} has no vowel"),
        }
    }
    let mut out = Vec::new();
    for (stress, rows) in groups {
        let mut starts = divide(&rows);
        starts.push(rows.len());
        for (i, pair) in starts.windows(2).enumerate() {
            let names = rows[pair[0]..pair[1]].iter().map(|r| r.names[set as usize]);
            out.push(Syllable {
                stress: if i == 0 { stress } else { 0 },
                phones: names.flat_map(str::split_ascii_whitespace).collect(),
            });
        }
    }
    Ok(out)
}

/// Returns the phones of letters with durations: the number of letters in each, its stress, and its
/// names in a set. A stress mark belongs to the following phone, a modifier to the phone that it
/// modifies; leading letters that are not phones here form a phone without a name.
pub(super) fn spans(letters: &[char], set: Set) -> Vec<(usize, u8, &'static str)> {
    let mut out: Vec<(usize, u8, &'static str)> = Vec::new();
    let (mut waiting, mut stress) = (0, 0);
    let mut rest = letters;
    while let Some((first, after)) = rest.split_first() {
        if let Some(mark) = ['ˈ', 'ˌ'].iter().position(|m| m == first) {
            (waiting, stress) = (waiting + 1, mark as u8 + 1);
            rest = after;
            continue;
        }
        let one = written_as_one(*first);
        let found = match one {
            Some(phones) => find(&phones.chars().collect::<Vec<_>>()).map(|(row, _)| (row, 1)),
            None => find(rest),
        };
        match (found, out.last_mut()) {
            (Some((row, length)), _) => {
                out.push((waiting + length, stress, row.names[set as usize]));
                (waiting, stress) = (0, 0);
                rest = &rest[length..];
            }
            (None, Some(last)) => {
                last.0 += waiting + 1;
                waiting = 0;
                rest = after;
            }
            (None, None) => {
                waiting += 1;
                rest = after;
            }
        }
    }
    if let Some(last) = out.last_mut() {
        last.0 += waiting;
    }
    out
}

/// Returns the two IPA letters for which Kokoro writes one letter; `None` for other letters.
fn written_as_one(letter: char) -> Option<&'static str> {
    Some(match letter {
        'I' => "aɪ",
        'W' => "aʊ",
        'A' => "eɪ",
        'O' => "oʊ",
        'Y' => "ɔɪ",
        'ʧ' => "tʃ",
        'ʤ' => "dʒ",
        _ => return None,
    })
}

/// Converts a phone that an aligner names in IPA, with any marks, to phones of SAMPA, which covers
/// all languages here; if the mouth does not know them, to the English ones. `None` if it is not in
/// the table.
pub(super) fn in_sampa(label: &str) -> Option<Vec<&'static str>> {
    let of = |row: &'static Row, set: Set| row.names[set as usize].split_ascii_whitespace();
    let mut names = Vec::new();
    for row in rows(label)? {
        if of(row, Set::Sampa).all(|name| phones::find("sampa", name).is_some()) {
            names.extend(of(row, Set::Sampa));
        } else {
            let english = of(row, Set::Radio);
            names.extend(english.filter_map(|name| phones::translate("radio", name, "sampa")));
        }
    }
    (!names.is_empty()).then_some(names)
}

/// Returns true if a label is a single IPA phone. Several letters that are phones each may be a
/// name of another set.
pub(super) fn is_phone(label: &str) -> bool {
    rows(label).is_some_and(|rows| rows.count() == 1)
}

/// Returns the rows of a label that consists only of phones and stress.
fn rows(label: &str) -> Option<impl Iterator<Item = &'static Row>> {
    let pieces = pieces(label).ok()?;
    let fine = !pieces.iter().any(|p| matches!(p, IpaSymbol::Dot));
    fine.then(|| {
        pieces.into_iter().filter_map(|piece| match piece {
            IpaSymbol::Phone(row) => Some(row),
            IpaSymbol::Stress(_) | IpaSymbol::Dot => None,
        })
    })
}

/// Returns the starts of a word's syllables, for the phones of an engine that does not report them.
/// An unknown phone counts as an ordinary consonant.
pub(super) fn starts<'a>(phones: impl Iterator<Item = &'a str>, set: Set) -> Vec<usize> {
    let unknown = &TABLE[TABLE.len() - 1];
    let rows: Vec<&Row> = phones
        .map(|phone| {
            let named = TABLE.iter().find(|r| r.names[set as usize] == phone);
            match named {
                Some(row) => row,
                None if is_vowel(phone, set) => &TABLE[0],
                None => unknown,
            }
        })
        .collect();
    divide(&rows)
}

/// Returns true if a phone of an engine is a vowel.
pub(super) fn is_vowel(phone: &str, set: Set) -> bool {
    let name = match set {
        Set::Radio => "radio",
        Set::Mrpa => "mrpa",
        Set::Sampa => "sampa",
        Set::Espeak => "espeak",
        Set::EspeakDe => "espeak-de",
        Set::EspeakPt => "espeak-pt",
    };
    TABLE
        .iter()
        .any(|r| r.sonority == Vowel && r.names[set as usize] == phone)
        || phones::find(name, phone)
            .is_some_and(|p| matches!(p.class, Class::Vowel | Class::Diphthong))
}

/// Returns the starts of syllables: each has a vowel, preceded by the maximal onset of consonants
/// with rising sonority, and s before stops.
fn divide(rows: &[&Row]) -> Vec<usize> {
    let rises = |pair: &[&Row]| {
        pair[0].sonority < pair[1].sonority && pair[1].sonority > Nasal
            || matches!(pair[0].ipa, "s" | "ʃ") && pair[1].sonority != Fricative
    };
    let mut out = vec![0];
    let mut last = None;
    for (i, row) in rows.iter().enumerate() {
        if row.sonority != Vowel {
            continue;
        }
        if let Some(last) = last {
            let begin = (last + 1..i)
                .find(|b| rows[*b].ipa != "ŋ" && rows[*b..i].windows(2).all(rises))
                .unwrap_or(i);
            out.push(begin);
        }
        last = Some(i);
    }
    out
}

fn pieces(ipa: &str) -> Result<Vec<IpaSymbol>> {
    ensure!(
        ipa.chars().count() <= MAX_CHARACTERS,
        "a pronunciation of more than {MAX_CHARACTERS} characters"
    );
    let mut chars = Vec::new();
    for c in ipa.chars().filter(|c| !IGNORED.contains(*c)) {
        match replaced(c) {
            [] => chars.push(c),
            others => chars.extend(others),
        }
    }
    let mut out = Vec::new();
    let mut rest = chars.as_slice();
    while let Some((first, after)) = rest.split_first() {
        match first {
            'ˈ' | '\'' => out.push(IpaSymbol::Stress(1)),
            'ˌ' | ',' => out.push(IpaSymbol::Stress(2)),
            '.' | '-' | '/' | '[' | ']' | '‿' | '|' => out.push(IpaSymbol::Dot),
            c if c.is_whitespace() => out.push(IpaSymbol::Dot),
            // Long and nasal phones in a language without them, and consonants.
            'ː' | &NASAL => {}
            &SYLLABIC => {
                let consonant = out.pop();
                out.extend(find(&['ə']).map(|(row, _)| IpaSymbol::Phone(row)));
                out.extend(consonant);
            }
            c => {
                let Some((row, length)) = find(rest) else {
                    bail!("the pronunciation {ipa:?} contains {c:?}, which is not a known phone");
                };
                out.push(IpaSymbol::Phone(row));
                rest = &rest[length..];
                continue;
            }
        }
        rest = after;
    }
    Ok(out)
}

/// Returns the row with the longest IPA name that begins the text, and the length of the name.
fn find(text: &[char]) -> Option<(&'static Row, usize)> {
    TABLE
        .iter()
        .filter_map(|row| {
            let length = row.ipa.chars().count();
            let same = text.len() >= length && row.ipa.chars().eq(text[..length].iter().copied());
            same.then_some((row, length))
        })
        .max_by_key(|(_, length)| *length)
}

#[cfg(test)]
mod tests;
