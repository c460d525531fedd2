//! Script for Festival. Texts are untrusted: they appear in it only as string literals.
//! Pronunciations are written only in the names of [`crate::ipa`].

use core::fmt::Write as _;

use crate::spoken::{Sentence, Token};
use anyhow::{Context as _, Result};
use raconteur_speech::bundle::SentenceKind;

use super::punctuation;
use crate::ipa::{self, Set};

/// Returns true if the name is safe as a bare symbol in a Scheme script.
pub(super) fn is_symbol(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

/// Returns a Scheme string literal. Festival's reader knows `\"` and `\\`; control characters and
/// characters beyond ASCII, which it would pass on raw, become spaces.
pub(super) fn literal(text: &str) -> String {
    let mut out = String::with_capacity(text.len() + 2);
    out.push('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => {
                out.push('\\');
                out.push(c);
            }
            ' '..='~' => out.push(c),
            _ => out.push(' '),
        }
    }
    out.push('"');
    out
}

/// Converts a token's text to plain letters for Festival's English; empty if nothing of it can be
/// spoken.
pub(super) fn plain(text: &str) -> String {
    let kept: String = deunicode::deunicode(text)
        .chars()
        .filter(|c| c.is_ascii_graphic() && !matches!(c, '"' | '\\' | '[' | ']'))
        .take(super::MAX_CHARACTERS)
        .collect();
    if kept.bytes().any(|b| b.is_ascii_alphanumeric()) {
        kept
    } else {
        String::new()
    }
}

/// Returns the audio file name of sentence `index`, in the folder where the script runs.
pub(super) fn wave_name(index: usize) -> String {
    format!("{index}.wav")
}

/// Prelude that sets up speech. Tokens are passed ready-made, with their number, so the engine's
/// own tokeniser never sees the text. A token with a pause gets a phrase break after it. Stressed
/// syllables of emphasised words get an accent, those of reduced ones lose theirs: voices with
/// pitch targets read the accent from the intonation tree, HTS voices from the flag.
const PRELUDE: &str = r#"
(define (raconteur_breaks utt)
  (mapcar
    (lambda (w)
      (if (and (string-equal "1" (item.feat w "R:Token.parent.raconteur_pause"))
               (not (item.relation.next w 'Token)))
          (item.set_feat w "pbreak" "B")))
    (utt.relation.items utt 'Word)))
(define (raconteur_accent utt s)
  (item.set_feat s "accented" 1)
  (if (string-equal "NONE" (item.feat s "tobi_accent"))
      (begin
        (if (not (item.relation s 'Intonation))
            (utt.relation.append utt 'Intonation s))
        (item.relation.append_daughter s 'Intonation
          (utt.relation.append utt 'IntEvent '("H*" ((name "H*"))))))))
(define (raconteur_reduce s)
  (item.set_feat s "accented" 0)
  (mapcar
    (lambda (e) (if (not (string-matches (item.name e) ".*%")) (item.delete e)))
    (item.relation.daughters s 'Intonation)))
(define (raconteur_accents utt)
  (mapcar
    (lambda (s)
      (let ((emphasis (item.feat s "R:SylStructure.parent.R:Token.parent.raconteur_emphasis")))
        (if (and (string-equal "1" emphasis) (string-equal "1" (item.feat s "stress")))
            (raconteur_accent utt s))
        (if (string-equal "-1" emphasis)
            (raconteur_reduce s))))
    (utt.relation.items utt 'Syllable)))
(define (raconteur_say tokens file)
  (let ((utt (Utterance Tokens nil)))
    (utt.relation.create utt 'Token)
    (mapcar (lambda (token) (utt.relation.append utt 'Token token)) tokens)
    (Token_POS utt)
    (Token utt)
    (POS utt)
    (Phrasify utt)
    (raconteur_breaks utt)
    (Word utt)
    (Pauses utt)
    (Intonation utt)
    (raconteur_accents utt)
    (PostLex utt)
    (Duration utt)
    (Int_Targets utt)
    (Wave_Synth utt)
    (format t "sentence %s %l\n" file (Param.get 'PhoneSet))
    (mapcar
      (lambda (s)
        (format t "segment %s %.4f %s %s %s %s\n" (item.name s) (item.feat s "end")
          (item.feat s "R:SylStructure.parent.parent.R:Token.parent.raconteur_token")
          (item.feat s "R:SylStructure.p.name")
          (item.feat s "R:SylStructure.parent.stress")
          (item.feat s "R:SylStructure.parent.tobi_accent")))
      (utt.relation.items utt 'Segment))
    (mapcar
      (lambda (w)
        (if (string-matches (item.feat w "pbreak") "B+")
            (format t "break %s %s\n" (item.feat w "R:Token.parent.raconteur_token")
              (item.feat w "R:SylStructure.daughtern.tobi_endtone"))))
      (utt.relation.items utt 'Word))
    (utt.save.wave utt file 'riff)))
"#;

/// Lists every installed voice with its description.
pub(super) const VOICES: &str = r#"
(mapcar
  (lambda (v)
    (let ((about (cadr (voice.description v))))
      (format t "voice %s %l %l %l\n" v
        (string-append "" (cadr (assoc 'language about)))
        (string-append "" (cadr (assoc 'dialect about)))
        (string-append "" (cadr (assoc 'gender about))))))
  (voice.list))
"#;

/// Returns the whole script: it loads the voice, speaks every sentence, writes its audio to
/// [`wave_name`], and its segments and phrases to standard output.
///
/// # Errors
/// Returns an error if a pronunciation contains phones that do not exist.
pub(super) fn script(sentences: &[Sentence], voice: &str, set: Set) -> Result<String> {
    let mut out = format!("(voice_{voice})\n");
    let mut said = String::new();
    for (i, sentence) in sentences.iter().enumerate() {
        said.push_str("(raconteur_say '(");
        for (t, token) in sentence.tokens.iter().enumerate() {
            let name = match &token.ipa {
                Some(ipa) => {
                    // A word in no lexicon, in letters only: digits would be read aloud.
                    let name = format!("raconteuri{}ki{}", spelled(i), spelled(t));
                    entry(&mut out, &name, ipa, set)
                        .with_context(|| format!("the word {:?}", token.text))?;
                    name
                }
                None => plain(&token.text),
            };
            if !name.is_empty() {
                let last = t + 1 == sentence.tokens.len();
                said.push_str(&token_form(token, t, &name, last.then_some(sentence.kind)));
            }
        }
        let _ = writeln!(said, ") {})", literal(&wave_name(i)));
    }
    out.push_str(PRELUDE);
    out.push_str(&said);
    Ok(out)
}

/// Spells a number in syllables, one per digit. flite would spell out anything unpronounceable.
pub(super) fn spelled(number: usize) -> String {
    const DIGITS: [&str; 10] = ["ba", "be", "bi", "bo", "bu", "da", "de", "di", "do", "du"];
    number
        .to_string()
        .bytes()
        .filter_map(|b| DIGITS.get(usize::from(b.wrapping_sub(b'0'))))
        .copied()
        .collect()
}

/// Puts a pronunciation into the voice's lexicon.
fn entry(out: &mut String, name: &str, ipa: &str, set: Set) -> Result<()> {
    let _ = write!(out, "(lex.add.entry '({} nil (", literal(name));
    for syllable in ipa::syllables(ipa, set)? {
        out.push_str("((");
        for phone in &syllable.phones {
            let _ = write!(out, " {phone}");
        }
        // Its lexicons know no secondary stress.
        let _ = write!(out, ") {})", u8::from(syllable.stress > 0));
    }
    out.push_str(")))\n");
    Ok(())
}

fn token_form(token: &Token, index: usize, name: &str, ends: Option<SentenceKind>) -> String {
    let name = literal(name);
    let mut form = format!("\n ({name} ((name {name}) (whitespace \" \") (prepunctuation \"\")");
    let punctuation = punctuation(token, ends);
    if !punctuation.is_empty() {
        let _ = write!(form, " (punc {})", literal(&punctuation));
    }
    if token.emphasis > 0.5 {
        form.push_str(" (raconteur_emphasis \"1\")");
    } else if token.emphasis < 0.5 {
        form.push_str(" (raconteur_emphasis \"-1\")");
    }
    if token.pause {
        form.push_str(" (raconteur_pause \"1\")");
    }
    // Counted from 1, because Festival answers 0 for a feature that is not there.
    let _ = write!(form, " (raconteur_token \"{}\")))", index + 1);
    form
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Parses a script strictly: returns the strings and the number of forms, or `None` if quotes
    /// or brackets do not match.
    fn read(script: &str) -> Option<(Vec<String>, usize)> {
        let (mut strings, mut depth, mut forms) = (Vec::new(), 0_i32, 0);
        let mut chars = script.chars();
        while let Some(c) = chars.next() {
            match c {
                '"' => {
                    let mut s = String::new();
                    loop {
                        match chars.next()? {
                            '"' => break,
                            '\\' => s.push(chars.next()?),
                            c => s.push(c),
                        }
                    }
                    strings.push(s);
                }
                '(' => {
                    forms += i32::from(depth == 0);
                    depth += 1;
                }
                ')' => depth -= 1,
                _ => {}
            }
            if depth < 0 {
                return None;
            }
        }
        (depth == 0).then_some((strings, usize::try_from(forms).ok()?))
    }

    fn sentence(text: &str, ipa: Option<&str>) -> Sentence {
        Sentence {
            tokens: vec![Token {
                text: text.to_owned(),
                ipa: ipa.map(str::to_owned),
                punctuation: text.to_owned(),
                emphasis: 1.0,
                pause: true,
                ..Token::default()
            }],
            ..Sentence::default()
        }
    }

    #[test]
    fn a_text_stays_inside_its_string_whatever_it_holds() {
        let of = |text: &str| read(&script(&[sentence(text, None)], "v", Set::Radio).unwrap());
        let usual = of("x").unwrap();
        for nasty in [
            "x\") (system \"rm -rf /\") (\"",
            "\\x",
            "x\\\"",
            "x\"",
            "a\nb\u{0}",
            "')(;#|x",
            "%s%n",
            "\u{e9}\u{201d}\u{ff08}",
        ] {
            let (strings, forms) = of(nasty).unwrap();
            assert_eq!(
                (strings.len(), forms),
                (usual.0.len(), usual.1),
                "{nasty:?}"
            );
            let kept = plain(nasty);
            assert!(
                !kept.is_empty() && !kept.contains(['"', '\\', ' ']),
                "the text contains no quotes, backslashes or spaces"
            );
            assert_eq!(
                strings.iter().filter(|s| **s == kept).count(),
                2,
                "{nasty:?}"
            );
        }
    }

    #[test]
    fn literals_read_back_as_what_was_written() {
        for text in ["", "a", "\"", "\\", "\\\"\\", "a b\"c"] {
            assert_eq!(read(&literal(text)), Some((vec![text.to_owned()], 0)));
        }
        assert_eq!(literal("a\n\u{e9}"), "\"a  \"");
    }

    #[test]
    fn nothing_that_could_be_said_is_no_token() {
        for text in ["", "-", "''", "\u{2014}", "\u{0}\u{1}"] {
            assert_eq!(plain(text), "", "{text:?}");
        }
        assert_eq!(plain("na\u{ef}ve"), "naive");
        assert_eq!(plain("dog's"), "dog's");
        let script = script(&[sentence("-", None)], "v", Set::Radio).unwrap();
        assert!(
            script.ends_with("(raconteur_say '() \"0.wav\")\n"),
            "{script}"
        );
    }

    #[test]
    fn a_pronunciation_is_a_word_of_the_lexicon() {
        let said = script(&[sentence("tomato", Some("təˈmɑːtoʊ"))], "v", Set::Radio).unwrap();
        assert!(
            said.contains(
                "(lex.add.entry '(\"raconteuribakiba\" nil ((( t ax) 0)(( m aa) 1)(( t ow) 0))))"
            ),
            "{said}"
        );
        assert!(
            read(&said).is_some() && !said.contains("tomato"),
            "the pronunciation replaces the spelling"
        );
        assert!(
            script(&[sentence("x", Some("\") (quit)"))], "v", Set::Radio).is_err(),
            "an invalid pronunciation is rejected"
        );
    }

    #[test]
    fn only_plain_names_are_symbols() {
        for (name, fine) in [
            ("cmu_us_slt_arctic_hts", true),
            ("", false),
            ("a b", false),
            ("a)", false),
            ("a\"", false),
        ] {
            assert_eq!(is_symbol(name), fine, "{name}");
        }
    }

    #[test]
    fn what_is_fixed_is_balanced() {
        assert_eq!(read(PRELUDE).unwrap().1, 5);
        assert_eq!(read(VOICES).unwrap().1, 1);
    }
}
