//! Takes comments and needless space out of the shaders and shortens what they name: they travel
//! to the browser as text.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::{env, fs, io};

fn main() -> io::Result<()> {
    println!("cargo::rerun-if-changed=src/shader");
    let out = env::var_os("OUT_DIR").ok_or_else(|| io::Error::other("cargo sets OUT_DIR"))?;
    let entries: io::Result<Vec<_>> = fs::read_dir("src/shader")?.collect();
    let mut files: Vec<PathBuf> = entries?.into_iter().map(|entry| entry.path()).collect();
    files.sort();
    let texts: io::Result<Vec<String>> = files.iter().map(|f| lean(f)).collect();
    let texts = texts?;
    let short = short_names(&texts.concat());
    for (path, text) in files.iter().zip(&texts) {
        if let Some(name) = path.file_name() {
            fs::write(Path::new(&out).join(name), renamed(text, &short))?;
        }
    }
    Ok(())
}

/// The text of a shader without comments and needless space.
fn lean(path: &Path) -> io::Result<String> {
    let text = fs::read_to_string(path)?;
    // WGSL has no string literals, so two slashes always begin a comment.
    let lines = text
        .lines()
        .map(|line| line.split("//").next().unwrap_or_default().trim())
        .filter(|line| !line.is_empty());
    Ok(lines.map(|line| tight(line) + "\n").collect())
}

/// A word, a number or another single character of a shader.
fn tokens(text: &str) -> impl Iterator<Item = &str> {
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut rest = text;
    std::iter::from_fn(move || {
        let first = rest.chars().next()?;
        let end = if is_word(first) {
            rest.find(|c| !is_word(c)).unwrap_or(rest.len())
        } else {
            first.len_utf8()
        };
        let (token, after) = rest.split_at(end);
        rest = after;
        Some(token)
    })
}

fn is_name(token: &str) -> bool {
    token.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_')
}

/// Whether a name may stand for components of a vector after a dot.
fn is_swizzle(name: &str) -> bool {
    let of = |letters: &str| name.chars().all(|c| letters.contains(c));
    name.len() <= 4 && (of("xyzw") || of("rgba"))
}

/// Short names for what all shaders together declare, the most frequent first. What the program
/// knows by name keeps it: entry points and overrides.
fn short_names(text: &str) -> BTreeMap<String, String> {
    let all: Vec<&str> = tokens(text).filter(|t| !t.trim().is_empty()).collect();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    let (mut declared, mut kept) = (BTreeSet::new(), BTreeSet::new());
    let (mut functions, mut called) = (BTreeSet::new(), BTreeSet::new());
    for (i, &token) in all.iter().enumerate().filter(|(_, t)| is_name(t)) {
        *counts.entry(token).or_default() += 1;
        let before = |n: usize| i.checked_sub(n).map_or("", |k| all[k]);
        let next = all.get(i + 1).copied().unwrap_or_default();
        match before(1) {
            // After `@vertex` or `@fragment`.
            "fn" if before(3) == "@" => _ = kept.insert(token),
            "fn" => _ = functions.insert(token),
            "let" | "var" | "const" | "struct" => _ = declared.insert(token),
            // `var<uniform> name`
            ">" if before(4) == "var" => _ = declared.insert(token),
            "override" | "@" => _ = kept.insert(token),
            _ if next == ":" => _ = declared.insert(token),
            _ if next == "(" => _ = called.insert(token),
            _ => {}
        }
    }
    // A name that is also a function's of the language would be hard to tell from it.
    let mut renamed: Vec<&str> = declared.difference(&called).copied().collect();
    renamed.extend(&functions);
    renamed.retain(|name| !kept.contains(name) && !is_swizzle(name) && *name != "default");
    renamed.sort_unstable();
    renamed.dedup();
    renamed.sort_by_key(|name| std::cmp::Reverse(counts[name]));
    let taken: BTreeSet<&str> = counts
        .keys()
        .copied()
        .filter(|name| !renamed.contains(name))
        .collect();
    let free = (0..).map(letters).filter(|name| {
        let is_keyword = matches!(&**name, "fn" | "if" | "as" | "do" | "or" | "of");
        !is_keyword && !is_swizzle(name) && !taken.contains(&**name)
    });
    renamed.iter().map(|n| (*n).to_owned()).zip(free).collect()
}

/// The nth shortest name of letters.
fn letters(n: usize) -> String {
    const LETTERS: &[u8; 52] = b"abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    let last = char::from(LETTERS[n % 52]);
    match n / 52 {
        0 => last.to_string(),
        more => letters(more - 1) + &last.to_string(),
    }
}

/// A text with short names; what stands in an attribute is of the language.
fn renamed(text: &str, short: &BTreeMap<String, String>) -> String {
    let mut out = String::with_capacity(text.len());
    let mut in_builtin = false;
    for token in tokens(text) {
        let own = short.get(token).filter(|_| !in_builtin);
        in_builtin = token == "builtin" || (in_builtin && token == "(");
        out.push_str(own.map_or(token, String::as_str));
    }
    out
}

/// Leaves out spaces beside punctuation. Minus, ampersand and bar keep theirs: two of them
/// together mean something else.
fn tight(line: &str) -> String {
    let closes = |c: char| "(){},;:=*+/<>".contains(c);
    let mut out = String::with_capacity(line.len());
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        let beside =
            out.chars().last().is_some_and(closes) || rest.peek().is_some_and(|n| closes(*n));
        if c != ' ' || !beside {
            out.push(c);
        }
    }
    out
}
