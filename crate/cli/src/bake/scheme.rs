//! The script that Festival runs. Texts come from strangers: they appear in it only as
//! string literals.

use core::fmt::Write as _;

use super::plan::{Sentence, Token};

/// Is this safe as a bare name in a script?
pub(crate) fn is_symbol(name: &str) -> bool {
    !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_')
}

/// A Scheme string literal. Festival's reader knows `\"` and `\\`; control characters and
/// what is not ASCII, which it would pass on raw, become spaces.
pub(crate) fn literal(text: &str) -> String {
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

/// Name of the sound of sentence `index`, in the folder where the script runs.
pub(crate) fn wave_name(index: usize) -> String {
    format!("{index}.wav")
}

/// Sets up speaking. Tokens are given ready-made, with the number of their word, so the
/// engine's own tokeniser never sees the text. A token with a pause gets a phrase break
/// after it. Stressed syllables of emphasised words get an accent.
const PRELUDE: &str = r#"
(define (raconteur_breaks utt)
  (mapcar
    (lambda (w)
      (if (and (string-equal "1" (item.feat w "R:Token.parent.raconteur_pause"))
               (not (item.relation.next w 'Token)))
          (item.set_feat w "pbreak" "B")))
    (utt.relation.items utt 'Word)))
(define (raconteur_accents utt)
  (mapcar
    (lambda (s)
      (let ((emphasis (item.feat s "R:SylStructure.parent.R:Token.parent.raconteur_emphasis")))
        (if (and (string-equal "1" emphasis) (string-equal "1" (item.feat s "stress")))
            (item.set_feat s "accented" 1))
        (if (string-equal "-1" emphasis)
            (item.set_feat s "accented" 0))))
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
    (format t "sentence %s\n" file)
    (mapcar
      (lambda (s)
        (format t "segment %s %.4f %s\n" (item.name s) (item.feat s "end")
          (item.feat s "R:SylStructure.parent.parent.R:Token.parent.raconteur_word")))
      (utt.relation.items utt 'Segment))
    (utt.save.wave utt file 'riff)))
"#;

/// The whole script: loads the voice, speaks every sentence, writes its sound to
/// [`wave_name`] and its segments to standard output.
pub(crate) fn script(sentences: &[Sentence], voice: &str, rate: f64) -> String {
    let mut out = format!("(voice_{voice})\n");
    // HTS voices have a rate of their own; the others obey the duration stretch.
    let _ = writeln!(out, "(Parameter.set 'Duration_Stretch {:.3})", 1.0 / rate);
    let _ = writeln!(
        out,
        "(if (symbol-bound? 'hts_engine_params)\n  \
         (set! hts_engine_params (append hts_engine_params '((\"-r\" {rate:.3})))))"
    );
    out.push_str(PRELUDE);
    for (i, sentence) in sentences.iter().enumerate() {
        out.push_str("(raconteur_say '(");
        for token in &sentence.tokens {
            out.push_str(&token_form(token));
        }
        let _ = writeln!(out, ") {})", literal(&wave_name(i)));
    }
    out
}

fn token_form(token: &Token) -> String {
    let name = literal(&token.text);
    let mut form = format!("\n ({name} ((name {name}) (whitespace \" \") (prepunctuation \"\")");
    // A pause is a phrase break; the phrasing model hears those as commas.
    let punctuation = match (token.punctuation.as_str(), token.pause_secs) {
        ("", Some(_)) => ",",
        (written, _) => written,
    };
    if !punctuation.is_empty() {
        let _ = write!(form, " (punc {})", literal(punctuation));
    }
    if token.emphasis > 1.0 {
        form.push_str(" (raconteur_emphasis \"1\")");
    } else if token.emphasis < 1.0 {
        form.push_str(" (raconteur_emphasis \"-1\")");
    }
    if token.pause_secs.is_some() {
        form.push_str(" (raconteur_pause \"1\")");
    }
    // Counted from 1, because Festival answers 0 for a feature that is not there.
    let _ = write!(form, " (raconteur_word \"{}\")))", token.word + 1);
    form
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A reader as strict as a script needs it: the strings of a text, or `None` when
    /// quotes or brackets do not match.
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

    fn sentence(text: &str) -> Sentence {
        let token = Token {
            word: 0,
            text: text.to_owned(),
            punctuation: text.to_owned(),
            emphasis: 1.5,
            pause_secs: Some(0.3),
        };
        Sentence {
            tokens: vec![token],
        }
    }

    #[test]
    fn a_text_stays_inside_its_string_whatever_it_holds() {
        let plain = read(&script(&[sentence("x")], "v", 1.0)).unwrap();
        for nasty in [
            "\") (system \"rm -rf /\") (\"",
            "\\",
            "\\\"",
            "\"",
            "a\nb\u{0}",
            "')(;#|",
            "%s%n",
            "\u{e9}\u{201d}",
        ] {
            let (strings, forms) = read(&script(&[sentence(nasty)], "v", 1.0)).unwrap();
            assert_eq!(
                (strings.len(), forms),
                (plain.0.len(), plain.1),
                "{nasty:?}"
            );
            let kept: String = nasty
                .chars()
                .map(|c| if (' '..='~').contains(&c) { c } else { ' ' })
                .collect();
            assert_eq!(
                strings.iter().filter(|s| **s == kept).count(),
                3,
                "{nasty:?}"
            );
        }
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
    fn the_prelude_is_balanced() {
        assert_eq!(read(PRELUDE).unwrap().1, 3);
    }
}
