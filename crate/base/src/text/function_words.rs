//! Function words: articles, pronouns, prepositions, conjunctions, auxiliaries.

/// Function words of English, German and Portuguese, and a few frequent words that name nothing.
const FUNCTION_WORDS: &str = "a ab aber about after again all alle als also am an and any ao aos are as at até auch auf \
    aus be been before bei bem bin bis bist but by came can com como could cá da dann dar das \
    dass de dei dein deine dela dele dem den denn depois der des dessa desse desta deste deu \
    dich did die dies diese dieser dir disse disso diz do doch does dos down du durch e ein \
    eine einem einen einer eines ela elas ele eles em entre er era eram es essa esse esta estas \
    este estes está estão eu euch euer even ever every fez foi for foram from für gegen get got \
    haben had has hast hat hatte have he her here hers him hin his how há i ich if ihm ihn ihr \
    ihre ihrem ihren ihrer im immer in ins into is isso ist isto it its ja jede jeder just já \
    kam kann kein keine let lhe lá mag mais mal man mas may me mehr mein meine meinem meinen \
    meiner mesmo meu meus mich might minha mir mit much muito muss must my na nach nas nem \
    nicht no noch nor nos nossa nosso not num numa nun nur não nós o oder of off ohne on onde \
    one only or os our out over own para pela pelo pois por porque porquê quando que quem sagte \
    said say says schon se sei sein seine seinem seinen seiner sem ser seu seus shall she \
    should sich sie sind so sob sobre soll some sondern still sua suas such são só tal também \
    tat te tem tenho ter teu teus than that the their them then there these they this those \
    through tinha to toda todas todo todos too tua tudo two tão um uma umas und uns unser unter \
    up us vai vem very viel vir você vocês vom von vor vos wann war waren warum was we weg weil \
    welche wem wen wenn went wer werden were what when where which who whom why wie wieder will \
    wir wird with wo would wurde yes yet you your zu zum zur zwischen à às é über";

/// Returns true for a function word of English, German or Portuguese, given in lower case and
/// without punctuation.
#[must_use]
pub fn is_function_word(word: &str) -> bool {
    FUNCTION_WORDS
        .split_ascii_whitespace()
        .any(|own| own == word)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_that_name_things_are_no_function_words() {
        for word in ["the", "und", "você", "das", "uma", "she", "said"] {
            assert!(is_function_word(word), "{word}");
        }
        for word in ["goat", "Haus", "porta", "", "th"] {
            assert!(!is_function_word(word), "{word}");
        }
    }
}
