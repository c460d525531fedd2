//! Abbreviations and their expansion in context.

use super::language::Language;
use super::starters::is_starter;
use super::word::Word;

/// Context in which an abbreviation applies, and its ability to end a sentence with its full stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum AbbreviationUse {
    /// Applies before a name: "Dr. Smith".
    Title,
    /// Applies before a number: "No. 5".
    BeforeNumber,
    /// Applies after a number: "3 Mio.".
    AfterNumber,
    /// Within a sentence: "z. B.".
    Inner,
    /// Anywhere, also at a sentence's end: "etc.".
    Any,
}

use AbbreviationUse::{AfterNumber, Any, BeforeNumber, Inner, Title};

/// Written form without the last full stop; spoken form; context; true if it is unambiguous without
/// the stop.
type Row = (&'static str, &'static str, AbbreviationUse, bool);

const ENGLISH: &[Row] = &[
    ("Mr", "Mister", Title, true),
    ("Mrs", "Missus", Title, true),
    ("Ms", "Miz", Title, true),
    ("Dr", "Doctor", Title, true),
    ("Prof", "Professor", Title, true),
    ("Rev", "Reverend", Title, false),
    ("Gen", "General", Title, false),
    ("Col", "Colonel", Title, false),
    ("Capt", "Captain", Title, false),
    ("Lt", "Lieutenant", Title, false),
    ("Sgt", "Sergeant", Title, false),
    ("Gov", "Governor", Title, false),
    ("Rep", "Representative", Title, false),
    ("Pres", "President", Title, false),
    ("Hon", "Honourable", Title, false),
    ("Maj", "Major", Title, false),
    ("Cmdr", "Commander", Title, false),
    ("Adm", "Admiral", Title, false),
    ("Messrs", "Messieurs", Title, false),
    ("Mme", "Madame", Title, false),
    ("Sen", "Senator", Title, false),
    ("Mt", "Mount", Title, false),
    ("Ft", "Fort", Title, false),
    ("St", "Saint", Title, true),
    ("Jr", "Junior", Any, true),
    ("Sr", "Senior", Any, true),
    ("Co", "Company", Any, false),
    ("Inc", "Incorporated", Any, false),
    ("Ltd", "Limited", Any, true),
    ("Corp", "Corporation", Any, false),
    ("Bros", "Brothers", Any, false),
    ("Dept", "Department", Inner, false),
    ("Univ", "University", Inner, false),
    ("Hwy", "Highway", Any, false),
    ("a.k.a", "also known as", Inner, false),
    ("w/o", "without", Inner, true),
    ("w/", "with", Inner, true),
    ("c/o", "care of", Inner, true),
    ("Ave", "Avenue", Any, false),
    ("Blvd", "Boulevard", Any, true),
    ("Rd", "Road", Any, false),
    ("etc", "et cetera", Any, true),
    ("vs", "versus", Inner, true),
    ("e.g", "for example", Inner, false),
    ("i.e", "that is", Inner, false),
    ("cf", "compare", Inner, false),
    ("viz", "namely", Inner, false),
    ("approx", "approximately", Inner, false),
    ("no", "number", BeforeNumber, false),
    ("nos", "numbers", BeforeNumber, false),
    ("p", "page", BeforeNumber, false),
    ("pp", "pages", BeforeNumber, false),
    ("ch", "chapter", BeforeNumber, false),
    ("vol", "volume", BeforeNumber, false),
    ("fig", "figure", BeforeNumber, false),
    ("sec", "section", BeforeNumber, false),
    ("c", "circa", BeforeNumber, false),
    ("ca", "circa", BeforeNumber, false),
    ("apt", "apartment", BeforeNumber, false),
    ("ext", "extension", BeforeNumber, false),
    ("Jan", "January", BeforeNumber, true),
    ("Feb", "February", BeforeNumber, true),
    ("Mar", "March", BeforeNumber, false),
    ("Apr", "April", BeforeNumber, true),
    ("Aug", "August", BeforeNumber, true),
    ("Sept", "September", BeforeNumber, true),
    ("Sep", "September", BeforeNumber, false),
    ("Oct", "October", BeforeNumber, true),
    ("Nov", "November", BeforeNumber, true),
    ("Dec", "December", BeforeNumber, true),
    ("a.m", "eigh em", Any, false),
    ("p.m", "pee em", Any, false),
    ("A.D", "eigh dee", Any, false),
    ("B.C", "bee see", Any, false),
    ("Ph.D", "pee eytch dee", Any, false),
];
const GERMAN: &[Row] = &[
    ("Hr", "Herr", Title, false),
    ("Hrn", "Herrn", Title, false),
    ("Fr", "Frau", Title, false),
    ("Dr", "Doktor", Title, true),
    ("Prof", "Professor", Title, true),
    ("med", "med", Title, false),
    ("phil", "phil", Title, false),
    ("jur", "jur", Title, false),
    ("St", "Sankt", Title, false),
    ("Dipl.-Ing", "Diplomingenieur", Title, false),
    ("z.B", "zum Beispiel", Inner, false),
    ("d.h", "das heißt", Inner, false),
    ("u.a", "unter anderem", Inner, false),
    ("z.T", "zum Teil", Inner, false),
    ("i.d.R", "in der Regel", Inner, false),
    ("v.a", "vor allem", Inner, false),
    ("bzw", "beziehungsweise", Inner, true),
    ("ca", "zirka", Inner, false),
    ("vgl", "vergleiche", Inner, false),
    ("inkl", "inklusive", Inner, false),
    ("evtl", "eventuell", Inner, false),
    ("exkl", "exklusive", Inner, false),
    ("einschl", "einschließlich", Inner, false),
    ("zzgl", "zuzüglich", Inner, false),
    ("mind", "mindestens", Inner, false),
    ("max", "maximal", Inner, false),
    ("bspw", "beispielsweise", Inner, false),
    ("o.ä", "oder ähnlich", Any, false),
    ("u.ä", "und ähnlich", Any, false),
    ("s.o", "siehe oben", Any, false),
    ("s.u", "siehe unten", Any, false),
    ("m.E", "meines Erachtens", Inner, false),
    ("u.U", "unter Umständen", Inner, false),
    ("e.V", "eh fau", Any, false),
    ("ggf", "gegebenenfalls", Inner, false),
    ("sog", "sogenannte", Inner, false),
    ("geb", "geboren", Inner, false),
    ("gest", "gestorben", Inner, false),
    ("v.Chr", "vor Christus", Any, false),
    ("n.Chr", "nach Christus", Any, false),
    ("usw", "und so weiter", Any, true),
    ("u.s.w", "und so weiter", Any, false),
    ("etc", "et cetera", Any, true),
    ("Str", "Straße", Any, false),
    ("nr", "Nummer", BeforeNumber, false),
    ("s", "Seite", BeforeNumber, false),
    ("bd", "Band", BeforeNumber, false),
    ("kap", "Kapitel", BeforeNumber, false),
    ("abb", "Abbildung", BeforeNumber, false),
    ("abs", "Absatz", BeforeNumber, false),
    ("art", "Artikel", BeforeNumber, false),
    ("tel", "Telefon", BeforeNumber, false),
    ("Mio", "Millionen", AfterNumber, true),
    ("Mrd", "Milliarden", AfterNumber, true),
    ("Tsd", "tausend", AfterNumber, false),
    ("Std", "Stunden", AfterNumber, false),
    ("Min", "Minuten", AfterNumber, false),
    ("Jh", "Jahrhundert", AfterNumber, false),
    ("Jan", "Januar", AfterNumber, false),
    ("Feb", "Februar", AfterNumber, false),
    ("Okt", "Oktober", AfterNumber, false),
    ("Nov", "November", AfterNumber, false),
    ("Dez", "Dezember", AfterNumber, false),
];
const PORTUGUESE: &[Row] = &[
    ("Sr", "senhor", Title, true),
    ("Sra", "senhora", Title, true),
    ("Sr.ª", "senhora", Title, true),
    ("Srta", "senhorita", Title, false),
    ("Srs", "senhores", Title, false),
    ("Dr", "doutor", Title, true),
    ("Dra", "doutora", Title, true),
    ("Dr.ª", "doutora", Title, true),
    ("Prof", "professor", Title, true),
    ("Prof.ª", "professora", Title, true),
    ("Profª", "professora", Title, true),
    ("Eng", "engenheiro", Title, false),
    ("Arq", "arquiteto", Title, false),
    ("Pe", "padre", Title, false),
    ("Sto", "santo", Title, false),
    ("Sta", "santa", Title, false),
    ("S", "são", Title, false),
    ("D", "dom", Title, false),
    ("Exmo", "excelentíssimo", Inner, false),
    ("Exma", "excelentíssima", Inner, false),
    ("p.ex", "por exemplo", Inner, false),
    ("i.e", "isto é", Inner, false),
    ("cf", "confira", Inner, false),
    ("aprox", "aproximadamente", Inner, false),
    ("ex", "exemplo", Inner, false),
    ("máx", "máximo", Inner, false),
    ("mín", "mínimo", Inner, false),
    ("Ltd", "limitada", Any, false),
    ("a.C", "antes de Cristo", Any, false),
    ("d.C", "depois de Cristo", Any, false),
    ("etc", "et cétera", Any, true),
    ("Av", "Avenida", Inner, false),
    ("Lda", "limitada", Any, false),
    ("n.º", "número", BeforeNumber, true),
    ("nº", "número", BeforeNumber, true),
    ("n.os", "números", BeforeNumber, true),
    ("p", "página", BeforeNumber, false),
    ("pp", "páginas", BeforeNumber, false),
    ("pág", "página", BeforeNumber, false),
    ("págs", "páginas", BeforeNumber, false),
    ("cap", "capítulo", BeforeNumber, false),
    ("vol", "volume", BeforeNumber, false),
    ("fig", "figura", BeforeNumber, false),
    ("art", "artigo", BeforeNumber, false),
    ("tel", "telefone", BeforeNumber, false),
    ("séc", "século", Inner, false),
];

/// Spoken form of an abbreviation, as words or letters to speak.
pub struct Expansion {
    /// Spoken text of each written word that it covers.
    pub spoken: Vec<String>,
    /// True if the spoken text consists of letters, pronounced by their names.
    pub is_spelled: bool,
    /// True if the abbreviation's last full stop also ends a sentence.
    pub ends: bool,
}

fn rows(language: Language) -> &'static [Row] {
    match language {
        Language::English => ENGLISH,
        Language::German => GERMAN,
        Language::Portuguese => PORTUGUESE,
    }
}

/// Returns the table row of an abbreviation as written, or with its initial in lower case; `None`
/// if unknown.
fn row(text: &str, language: Language) -> Option<&'static Row> {
    let rows = rows(language);
    rows.iter().find(|row| row.0 == text).or_else(|| {
        let mut chars = text.chars();
        let first = chars.next().filter(|c| c.is_uppercase())?;
        let small: String = first.to_lowercase().chain(chars).collect();
        rows.iter().find(|row| row.0 == small)
    })
}

/// Returns true if a word is an English day of the week.
fn is_day(word: &str) -> bool {
    word.len() > 5 && word.ends_with("day")
}

fn numeric(word: Option<&Word<'_>>) -> bool {
    word.is_some_and(|word| word.core.starts_with(|c: char| c.is_ascii_digit()))
}

/// Returns the expansion of the abbreviation at `at`, if there is one.
#[must_use]
pub fn expand(words: &[Word<'_>], at: usize, language: Language) -> Option<Expansion> {
    let word = words.get(at)?;
    // The longest is five letters and a few stops; most words end the search here.
    if word.core.len() > 10 || !word.dotted() && word.core.len() > 5 {
        return None;
    }
    if let Some(pair) = pair(words, at, language) {
        return Some(pair);
    }
    let next = words.get(at + 1);
    let previous = at.checked_sub(1).and_then(|at| words.get(at));
    let single = word.core.chars().count() == 1;
    let name_next = next.is_some_and(Word::is_capital) && matches!(word.end.as_str(), "" | ".");
    // "Mr. and Mrs. Brown"
    let joined = next.is_some_and(|w| {
        matches!(
            w.core.as_str(),
            "and" | "und" | "e" | "&" | "med" | "phil" | "jur"
        )
    });
    let found = row(&word.core, language).filter(|(name, _, place, bare)| {
        (word.dotted() || *bare || word.core.contains('.'))
            && match place {
                Title => name_next || joined,
                BeforeNumber => {
                    numeric(next)
                        || next.is_some_and(|w| {
                            // "No. I will."
                            let is_word = matches!(*name, "no" | "nos") && w.core.len() == 1;
                            super::roman::value(&w.core).is_some() && !single && !is_word
                        })
                }
                AfterNumber => numeric(previous),
                Inner | Any => true,
            }
    });
    let end_of_text = next.is_none();
    let Some(&(name, spoken, place, _)) = found else {
        return street(word, previous, next, language)
            .or_else(|| initials(word, single, name_next, next, language));
    };
    if let Some(street) = street(word, previous, next, language) {
        return Some(street);
    }
    let spoken = match (name, language) {
        // "D. Maria" is a lady, "D. João" a lord.
        ("D", Language::Portuguese) if next.is_some_and(|w| w.core.ends_with('a')) => "dona",
        ("Mio" | "Mrd", _) if previous.is_some_and(|w| w.core == "1") => {
            if name == "Mio" {
                "Million"
            } else {
                "Milliarde"
            }
        }
        _ => spoken,
    };
    let capital = match language {
        // A noun after an abbreviation has its capital in German anyway.
        Language::German => {
            next.is_none_or(Word::is_capital) && matches!(name, "usw" | "etc" | "u.s.w")
        }
        // "5 p.m. Monday" continues the sentence.
        _ => next.is_none_or(|next| next.is_capital() && !is_day(&next.core)),
    };
    let ends = end_of_text || place == Any && capital;
    Some(Expansion {
        spoken: vec![spoken.to_owned()],
        is_spelled: false,
        ends: ends && place != Title,
    })
}

/// Returns the expansion of a two-word abbreviation at `at` ("z. B.", "p. ex."); `None` if there is
/// none.
#[must_use]
pub fn pair(words: &[Word<'_>], at: usize, language: Language) -> Option<Expansion> {
    let (first, second) = (words.get(at)?, words.get(at + 1)?);
    if first.end != "." || !second.dotted() || first.core.len() > 2 {
        return None;
    }
    let (_, spoken, place, _) = row(&format!("{}.{}", first.core, second.core), language)?;
    let (head, tail) = spoken.split_once(' ')?;
    let next = words.get(at + 2);
    let ends = next.is_none() || *place == Any && next.is_some_and(Word::is_capital);
    Some(Expansion {
        spoken: vec![head.to_owned(), tail.to_owned()],
        is_spelled: false,
        ends,
    })
}

/// Expands English "St." and "Dr." after a name to Street and Drive ("Main St.", but not "Main St.
/// John"); otherwise `None`.
fn street(
    word: &Word<'_>,
    previous: Option<&Word<'_>>,
    next: Option<&Word<'_>>,
    language: Language,
) -> Option<Expansion> {
    let spoken = match word.core.as_str() {
        "St" => "Street",
        "Dr" => "Drive",
        _ => return None,
    };
    let named = previous.is_some_and(|w| {
        (w.is_capital() || w.core.ends_with("th")) && w.end.is_empty() && w.core.chars().count() > 2
    });
    // A word that begins a sentence is also capitalised; a common sentence starter indicates a
    // sentence end.
    let starts = next.is_some_and(|w| is_starter(&w.core, language));
    let quarter = next.is_some_and(|w| matches!(w.core.as_str(), "NW" | "NE" | "SW" | "SE"));
    let last = next.is_none_or(|w| !w.is_capital()) || starts || quarter;
    (language == Language::English && named && last).then(|| Expansion {
        spoken: vec![spoken.to_owned()],
        is_spelled: false,
        ends: next.is_none_or(Word::is_capital) && !quarter,
    })
}

/// Expands an initial before a name ("J.") and letters with full stops ("U.S.A."); otherwise
/// `None`.
fn initials(
    word: &Word<'_>,
    single: bool,
    name_next: bool,
    next: Option<&Word<'_>>,
    language: Language,
) -> Option<Expansion> {
    let letters: Vec<&str> = word.core.split('.').collect();
    let all = letters
        .iter()
        .all(|part| part.chars().count() == 1 && part.chars().all(char::is_uppercase));
    // "I" ends many an English sentence and begins no name.
    let first = single && word.dotted() && name_next && word.core != "I";
    if !all || letters.len() < 2 && !first {
        return None;
    }
    Some(Expansion {
        spoken: vec![letters.concat()],
        is_spelled: true,
        ends: !single && next.is_none_or(|next| is_starter(&next.core, language)),
    })
}
