//! Words that begin sentences.

use super::language::Language;

/// Words that, with a capital, rather begin a sentence than go on with it [English, German,
/// Portuguese].
const STARTERS: [&str; 3] = [
    "The He She It They We In A An I Then And But You This That There What When Where Who Why How \
     Yes So His Her My Your Our Their At On After Before If As For Not Now Here These Those Is Was \
     Did Do Can",
    "Es Er Sie Ich Wir Du Ihr Das Die Der Dann Und Aber In Im Am Da So Ein Eine Doch Nun Danach \
     Dort Hier Wer Was Wann Warum Wie Ja Nein Nicht Auch Alle Man Mein Meine Sein Seine Ist War",
    "O A Os As Um Uma Ele Ela Eles Elas Eu Nós Isto Isso Depois Então E Mas Quando Onde Quem Que \
     Como Porque Sim Não No Na Em Já Ali Aqui Agora Foi Era É Há",
];
/// Returns true if a capitalised word more likely begins a sentence.
#[must_use]
pub fn is_starter(word: &str, language: Language) -> bool {
    STARTERS[language as usize]
        .split_ascii_whitespace()
        .any(|own| own == word)
}
