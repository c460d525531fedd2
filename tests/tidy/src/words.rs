//! Names and documentation use the field's terms: `docs/glossary.md` lists them with the former
//! names, which no declaration may have.

use std::collections::BTreeSet;
use std::fs;
use std::path::PathBuf;

use crate::files::all;

/// First words of a summary that asks instead of naming the item.
const QUESTIONS: [&str; 14] = [
    "What", "Whatever", "How", "However", "Whether", "Where", "Wherever", "When", "Who", "Whoever",
    "Whom", "Whose", "Which", "Why",
];

/// Prefixes of limits that are spelled `MAX_` or `MIN_`.
const SUPERLATIVES: [&str; 16] = [
    "MOST", "LEAST", "LONGEST", "SHORTEST", "LARGEST", "SMALLEST", "FASTEST", "SLOWEST", "DEEPEST",
    "WIDEST", "HIGHEST", "LOWEST", "FARTHEST", "STEEPEST", "FINEST", "FEWEST",
];

/// Function names that say nothing about what is constructed or evaluated.
const BARE: [&str; 2] = ["of", "at"];

/// Keywords before the name of a type or function, in Rust and TypeScript.
const KEYWORDS: [&str; 8] = [
    "struct",
    "enum",
    "trait",
    "type",
    "class",
    "interface",
    "fn",
    "function",
];

fn is_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The former names in the last column of the glossary's tables, without those that a note in
/// parentheses limits to one use.
fn former_names() -> BTreeSet<String> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../docs/glossary.md");
    let text = fs::read_to_string(path).expect("the glossary");
    let column = |line: &str| {
        let cells: Vec<&str> = line.split('|').collect();
        (cells.len() == 6).then(|| cells[4].to_owned())
    };
    let cells = text.lines().filter_map(column);
    let names = cells.flat_map(|cell| cell.split(',').map(str::to_owned).collect::<Vec<_>>());
    let is_limited = |name: &String| name.contains('(');
    let names = names.filter(|name| !is_limited(name));
    names
        .filter_map(|name| Some(name.trim().strip_prefix('`')?.strip_suffix('`')?.to_owned()))
        .collect()
}

/// The name that a line of code declares: the word after a keyword of [`KEYWORDS`].
fn declared(line: &str) -> Option<&str> {
    let mut words = line.split_whitespace();
    let name = words
        .by_ref()
        .take(5)
        .find(|word| KEYWORDS.contains(word))
        .and_then(|_| words.next());
    // The macros `words!` and `record!` of `eml` declare types as a name, its tag and a brace.
    let name = name.or_else(|| {
        let line = line.strip_prefix("    ").filter(|l| l.ends_with('{'))?;
        let (name, rest) = line.split_once(' ')?;
        (rest == "{" || rest.starts_with("= \"")).then_some(name)
    })?;
    Some(name.split(|c| !is_name(c)).next().unwrap_or_default())
}

/// The names of constants that a line declares with a superlative instead of `MAX` or `MIN`.
fn superlative(line: &str) -> Option<&str> {
    let (_, rest) = line
        .split_once("const ")
        .or_else(|| line.split_once("static "))?;
    let name = rest.split(|c| !is_name(c)).next().unwrap_or_default();
    let head = name.split('_').next().unwrap_or_default();
    SUPERLATIVES.contains(&head).then_some(name)
}

/// The first lines of documentation comments, with their line numbers from 1.
fn summaries(text: &str, is_rust: bool) -> Vec<(usize, &str)> {
    let mut found = Vec::new();
    let mut in_comment = false;
    for (i, line) in text.lines().enumerate() {
        let line = line.trim_start();
        if is_rust {
            let doc = line.strip_prefix("///").or(line.strip_prefix("//!"));
            if let Some(doc) = doc.filter(|_| !in_comment) {
                found.push((i + 1, doc.trim_start()));
            }
            in_comment = doc.is_some();
        } else if let Some(doc) = line.strip_prefix("/**") {
            in_comment = doc.trim().is_empty();
            if !in_comment {
                found.push((i + 1, doc.trim_start()));
            }
        } else if in_comment {
            found.push((i + 1, line.trim_start_matches('*').trim_start()));
            in_comment = false;
        }
    }
    found
}

fn asks(summary: &str) -> bool {
    let word = summary.split(|c| !is_name(c)).next().unwrap_or_default();
    QUESTIONS.contains(&word)
}

/// Fails with everything that `find` says of the lines of Rust and TypeScript.
fn refuse(find: impl Fn(&str, bool) -> Vec<(usize, String)>) {
    let mut faults = Vec::new();
    for (path, text) in all() {
        let extension = path.extension().unwrap_or_default();
        if extension != "rs" && extension != "ts" {
            continue;
        }
        for (line, what) in find(&text, extension == "rs") {
            faults.push(format!("{}:{line}: {what}", path.display()));
        }
    }
    assert!(
        faults.is_empty(),
        "{} faults:\n{}",
        faults.len(),
        faults.join("\n")
    );
}

#[test]
fn summaries_name_their_item() {
    refuse(|text, is_rust| {
        let asking = summaries(text, is_rust)
            .into_iter()
            .filter(|(_, s)| asks(s));
        asking.map(|(line, s)| (line, s.to_owned())).collect()
    });
}

#[test]
fn no_declaration_has_a_former_name() {
    let former = former_names();
    assert!(
        former.len() > 60,
        "the glossary has only {} former names",
        former.len()
    );
    refuse(|text, _| {
        let mut is_deprecated = false;
        let mut found = Vec::new();
        for (i, line) in text.lines().enumerate() {
            let is_bare = |name: &str| {
                BARE.contains(&name)
                    && [" ", "<", "("]
                        .iter()
                        .any(|end| line.contains(&["fn ", name, end].concat()))
                    && !line.trim_start().starts_with('/')
            };
            let is_refused = |name: &&str| former.contains(*name) || is_bare(name);
            let name = declared(line).filter(is_refused);
            if let Some(name) = name.filter(|_| !is_deprecated) {
                found.push((
                    i + 1,
                    format!("{name} is a former name or a bare preposition, see docs/glossary.md"),
                ));
            }
            is_deprecated = line.contains("@deprecated");
        }
        found
    });
}

#[test]
fn limits_are_max_and_min() {
    refuse(|text, _| {
        let lines = text.lines().enumerate();
        let found = lines.filter_map(|(i, line)| Some((i + 1, superlative(line)?.to_owned())));
        found.collect()
    });
}

#[test]
fn faults_are_found() {
    assert_eq!(
        declared(&["pub(crate) str", "uct Felt<'a> {"].concat()),
        Some("Felt"),
        "a type of Rust"
    );
    assert_eq!(
        declared(&["export interf", "ace Told {"].concat()),
        Some("Told"),
        "a type of TypeScript"
    );
    assert_eq!(
        declared(&["    pub f", "n hear(&mut self) {"].concat()),
        Some("hear"),
        "a method"
    );
    assert_eq!(
        superlative(&["pub con", "st MOST_SECS: f64 = 1.0;"].concat()),
        Some("MOST_SECS"),
        "a limit"
    );
    assert_eq!(
        superlative("const MAX_SECS = 1;"),
        None,
        "a limit as it should be"
    );
    let rust = "/// Returns it.\n/// What else.\nfn a() {}\n    /// How much.\n    b: f64,";
    let found: Vec<_> = summaries(rust, true)
        .into_iter()
        .filter(|(_, s)| asks(s))
        .collect();
    assert_eq!(found, [(4, "How much.")], "a summary of Rust");
    let ts = "/** Which one. */\n/**\n * Where it is.\n */\n/** The rest. */";
    let found: Vec<_> = summaries(ts, false)
        .into_iter()
        .filter(|(_, s)| asks(s))
        .collect();
    assert_eq!(found.len(), 2, "summaries of TypeScript");
}
