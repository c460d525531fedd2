//! Rating tables: four columns separated by tabs, `rater`, `face` (index of an example),
//! `attribute` and `value` (from −3 to 3). Lines that begin with `#` and lines without a value are
//! ignored.

use std::collections::BTreeMap;

use super::{AttributeRatings, Rating};

/// The columns of the table.
const COLUMNS: [&str; 4] = ["rater", "face", "attribute", "value"];
/// Values reach this far to either side.
const MAX_RATING: f64 = 3.0;
/// Maximum length of quoted input in an error message, characters.
const MAX_QUOTE_CHARS: usize = 40;

/// Instructions at the top of the rating form.
const INSTRUCTIONS: &str = "\
# value: how much of the attribute a face has among all faces, from -3 (least) over 0 (average) to 3 (most)
# Leave the value empty where you cannot say. Fill in your name, the same in all your lines and without # at its beginning.
";

/// Error returned when a table of ratings cannot be parsed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RatingError {
    /// The table is too long.
    #[error("there are more than {most} lines")]
    TooLong {
        /// Maximum number allowed.
        most: usize,
    },
    /// The table does not start with its column names.
    #[error("line {line}: the first line names the columns rater, face, attribute and value")]
    NoHeader {
        /// The line, counted from 1.
        line: usize,
    },
    /// A line has too many columns or too few.
    #[error("line {line} has {found} columns and not 4, with tabs between them")]
    Columns {
        /// The line, counted from 1.
        line: usize,
        /// Number found.
        found: usize,
    },
    /// The rater's name is missing.
    #[error("line {line} has a value and no rater")]
    NoRater {
        /// The line, counted from 1.
        line: usize,
    },
    /// The attribute name is missing.
    #[error("line {line} names no attribute")]
    NoAttribute {
        /// The line, counted from 1.
        line: usize,
    },
    /// The face is no index.
    #[error("line {line}: {found:?} is not the index of a face")]
    BadFace {
        /// The line, counted from 1.
        line: usize,
        /// Text found.
        found: String,
    },
    /// The table names a face index that does not exist.
    #[error("line {line}: there is no face {face} among {examples}")]
    UnknownFace {
        /// The line, counted from 1.
        line: usize,
        /// The index.
        face: usize,
        /// Number of faces.
        examples: usize,
    },
    /// The value is not on the scale.
    #[error("line {line}: {found:?} is not a number from -3 to 3")]
    BadValue {
        /// The line, counted from 1.
        line: usize,
        /// Text found.
        found: String,
    },
    /// A rater has rated a face twice.
    #[error("line {line}: {rater:?} has rated face {face} for {attribute:?} before")]
    Twice {
        /// The line, counted from 1.
        line: usize,
        /// Rater.
        rater: String,
        /// Face index.
        face: usize,
        /// Attribute rated.
        attribute: String,
    },
}

/// Ratings of faces by people, by attribute; attributes are learned from them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Ratings {
    attributes: BTreeMap<String, AttributeRatings>,
}

impl Ratings {
    /// Maximum number of lines in a table.
    pub const MAX_LINES: usize = 100_000;

    /// Returns an empty rating form: a line for each face and attribute, without rater and value.
    #[must_use]
    pub fn form(faces: &[usize], attributes: &[String]) -> String {
        let mut form = INSTRUCTIONS.to_owned() + &COLUMNS.join("\t") + "\n";
        for face in faces {
            for attribute in attributes {
                form += &format!("\t{face}\t{attribute}\t\n");
            }
        }
        form
    }

    /// Parses a tab-separated table of ratings.
    ///
    /// # Errors
    /// Returns an error if a line is malformed, or there are too many lines; the error names the
    /// first such line.
    pub fn parse(text: &str) -> Result<Self, RatingError> {
        let mut ratings = Self::default();
        let mut has_header = false;
        // Spreadsheets write an encoding mark first.
        let text = text.strip_prefix('\u{feff}').unwrap_or(text);
        for (line, content) in (1..).zip(text.lines()) {
            if line > Self::MAX_LINES {
                return Err(RatingError::TooLong {
                    most: Self::MAX_LINES,
                });
            }
            if content.starts_with('#') || content.trim().is_empty() {
                continue;
            }
            if has_header {
                ratings.read(line, content)?;
            } else if content.split('\t').map(str::trim).eq(COLUMNS) {
                has_header = true;
            } else {
                return Err(RatingError::NoHeader { line });
            }
        }
        if has_header {
            Ok(ratings)
        } else {
            Err(RatingError::NoHeader { line: 1 })
        }
    }

    /// Reads one line.
    fn read(&mut self, line: usize, content: &str) -> Result<(), RatingError> {
        let mut columns = content.split('\t').map(str::trim);
        let (Some(rater), Some(face), Some(attribute), Some(value), None) = (
            columns.next(),
            columns.next(),
            columns.next(),
            columns.next(),
            columns.next(),
        ) else {
            let found = content.split('\t').count();
            return Err(RatingError::Columns { line, found });
        };
        let Ok(face) = face.parse::<usize>() else {
            let found = quote(face);
            return Err(RatingError::BadFace { line, found });
        };
        if attribute.is_empty() {
            return Err(RatingError::NoAttribute { line });
        }
        if value.is_empty() {
            return Ok(());
        }
        if rater.is_empty() {
            return Err(RatingError::NoRater { line });
        }
        // Text programs make a minus sign of a hyphen.
        let number = value.replace('\u{2212}', "-").parse::<f64>();
        let Some(number) = number.ok().filter(|v| v.abs() <= MAX_RATING) else {
            let found = quote(value);
            return Err(RatingError::BadValue { line, found });
        };
        let rating = Rating {
            value: number,
            line,
        };
        self.insert(attribute, rater, face, rating)
    }

    fn insert(
        &mut self,
        attribute: &str,
        rater: &str,
        face: usize,
        rating: Rating,
    ) -> Result<(), RatingError> {
        let of = self.attributes.entry(attribute.to_owned()).or_default();
        let rated = of.raters.entry(rater.to_owned()).or_default();
        if rated.insert(face, rating).is_some() {
            return Err(RatingError::Twice {
                line: rating.line,
                rater: quote(rater),
                face,
                attribute: quote(attribute),
            });
        }
        Ok(())
    }

    /// Adds the ratings of another table.
    ///
    /// # Errors
    /// Returns an error if both tables contain a rating of the same face by the same rater; the
    /// line in the error is that of the other table.
    pub fn merge(&mut self, other: Self) -> Result<(), RatingError> {
        for (attribute, of) in other.attributes {
            for (rater, rated) in of.raters {
                for (face, rating) in rated {
                    self.insert(&attribute, &rater, face, rating)?;
                }
            }
        }
        Ok(())
    }

    /// Checks that all rated faces are among the given number of examples.
    ///
    /// # Errors
    /// Returns an error if a rated face is not among them; the error names the first such line.
    pub fn check_faces(&self, examples: usize) -> Result<(), RatingError> {
        let raters = self.attributes.values().flat_map(|of| of.raters.values());
        let beyond = raters.flat_map(|rated| rated.range(examples..));
        let first = beyond.min_by_key(|(_, rating)| rating.line);
        first.map_or(Ok(()), |(&face, rating)| {
            Err(RatingError::UnknownFace {
                line: rating.line,
                face,
                examples,
            })
        })
    }

    /// Returns the rated attributes with their ratings, sorted by name.
    pub fn attributes(&self) -> impl Iterator<Item = (&str, &AttributeRatings)> {
        self.attributes.iter().map(|(name, of)| (name.as_str(), of))
    }

    /// Returns the ratings of an attribute; `None` if nobody rated it.
    #[must_use]
    pub fn get(&self, attribute: &str) -> Option<&AttributeRatings> {
        self.attributes.get(attribute)
    }
}

/// Returns the quoted part of a text.
fn quote(text: &str) -> String {
    text.chars().take(MAX_QUOTE_CHARS).collect()
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const HEADER: &str = "rater\tface\tattribute\tvalue\n";

    fn parse(lines: &str) -> Result<Ratings, RatingError> {
        Ratings::parse(&format!("{HEADER}{lines}"))
    }

    #[test]
    fn a_form_is_a_table_that_nobody_has_rated() {
        let names = ["friendly", "age as seen"].map(str::to_owned);
        let form = Ratings::form(&[3, 17], &names);
        assert!(
            form.ends_with("\t3\tage as seen\t\n\t17\tfriendly\t\n\t17\tage as seen\t\n"),
            "the form lists each face and attribute"
        );
        assert_eq!(Ratings::parse(&form), Ok(Ratings::default()));
        // As a spreadsheet may write it, with the value of one line.
        let filled = form.replace("\t17\tfriendly\t\n", "Ann\t17\tfriendly\t \u{2212}1.5\n");
        let filled = format!("\u{feff}{}", filled.replace('\n', "\r\n"));
        let ratings = Ratings::parse(&filled).expect("a table");
        let found: Vec<&str> = ratings.attributes().map(|(name, _)| name).collect();
        assert_eq!(found, ["friendly"]);
        let of = ratings.get("friendly").expect("rated");
        assert_eq!(of.raters["Ann"][&17].value, -1.5);
        assert_eq!(ratings.get("age as seen"), None);
    }

    #[test]
    fn broken_lines_are_named() {
        let line = 3;
        let bad_value = |found: &str| RatingError::BadValue {
            line,
            found: found.to_owned(),
        };
        let bad_face = |found: &str| RatingError::BadFace {
            line,
            found: found.to_owned(),
        };
        let twice = RatingError::Twice {
            line,
            rater: "a".to_owned(),
            face: 0,
            attribute: "f".to_owned(),
        };
        for (broken, expected) in [
            ("a\t0\tf", RatingError::Columns { line, found: 3 }),
            ("a\t1\tf\t2\t\t", RatingError::Columns { line, found: 6 }),
            ("a,1,f,2", RatingError::Columns { line, found: 1 }),
            ("\t1\tf\t2", RatingError::NoRater { line }),
            ("a\t1\t \t2", RatingError::NoAttribute { line }),
            ("a\t-1\tf\t2", bad_face("-1")),
            ("a\t1.0\tf\t", bad_face("1.0")),
            ("a\t1\tf\t3.01", bad_value("3.01")),
            ("a\t1\tf\t1,5", bad_value("1,5")),
            ("a\t1\tf\tNaN", bad_value("NaN")),
            ("a\t1\tf\t-inf", bad_value("-inf")),
            ("a\t0\tf\t2", twice),
        ] {
            assert_eq!(
                parse(&format!("a\t0\tf\t1\n{broken}\n")),
                Err(expected),
                "{broken:?}"
            );
        }
        let told = parse("# so\n\na\t1\tf\tmuch").expect_err("no number");
        assert_eq!(
            told.to_string(),
            "line 4: \"much\" is not a number from -3 to 3"
        );
        let long = parse(&format!("a\t{}\tf\t1", "9".repeat(99))).expect_err("no index");
        let found = "9".repeat(MAX_QUOTE_CHARS);
        assert_eq!(long, RatingError::BadFace { line: 2, found });
    }

    #[test]
    fn other_files_are_no_tables() {
        for (text, line) in [("", 1), ("# nothing\n", 1), ("\n#\n{\"a\": 1}", 3)] {
            assert_eq!(Ratings::parse(text), Err(RatingError::NoHeader { line }));
        }
        let limit = Ratings::MAX_LINES;
        let most = "#\n".repeat(limit - 1);
        assert_eq!(parse(&most), Ok(Ratings::default()));
        let told = parse(&format!("{most}\n"));
        assert_eq!(told, Err(RatingError::TooLong { most: limit }));
    }

    #[test]
    fn tables_of_several_raters_are_one() {
        let mut ratings = parse("a\t0\tf\t1\na\t7\tg\t1\n").expect("a table");
        ratings
            .merge(parse("b\t0\tf\t2\na\t9\tg\t3\n").expect("a table"))
            .expect("other faces");
        assert_eq!(ratings.get("f").map(|f| f.agreement().raters), Some(2));
        assert_eq!(ratings.check_faces(10), Ok(()));
        let unknown = RatingError::UnknownFace {
            line: 3,
            face: 7,
            examples: 7,
        };
        assert_eq!(ratings.check_faces(7), Err(unknown));
        let again = ratings.merge(parse("\nb\t0\tf\t2").expect("a table"));
        assert!(
            matches!(
                again,
                Err(RatingError::Twice {
                    line: 3,
                    face: 0,
                    ..
                })
            ),
            "{again:?}"
        );
    }

    proptest! {
        #[test]
        fn no_text_panics(
            header: bool,
            text in "([ab#]?\t[0-3x]?\t[fg]?\t-?[0-4]?(\\.5)?\r?\n|.{0,20}\n?){0,12}",
            examples in 0..5_usize,
        ) {
            let text = if header { format!("{HEADER}{text}") } else { text };
            if let Ok(ratings) = Ratings::parse(&text) {
                let _ = ratings.check_faces(examples);
                for (_, of) in ratings.attributes() {
                    let _ = of.agreement();
                    prop_assert_eq!(of.labels(examples).len(), examples);
                }
            }
        }
    }
}
