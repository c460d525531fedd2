//! Speech for tests: generated, and that of the shipped stories.

use std::path::Path;
use std::sync::Arc;

use raconteur_base::{noise, ops};
use raconteur_speech::bundle::{
    Accent, Phrase, Sentence, SentenceKind, Syllable, code_of_db, code_of_hz,
};
use raconteur_speech::{Bundle, Phone, TimedUtterance, Utterance, Word};

/// One hour, seconds.
pub(crate) const HOUR_SECS: f64 = 3600.0;

/// Returns an hour of speech: sentences of phrases with accents, questions, searches for words, and
/// an occasional turn of another speaker.
pub(crate) fn hour(seed: u64) -> Vec<TimedUtterance> {
    let mut all = Vec::new();
    let mut at_secs = 1.0;
    while at_secs < HOUR_SECS {
        let id = all.len() as i64;
        let u = TimedUtterance {
            start_secs: at_secs,
            utterance: Arc::new(Maker::new(seed, id).utterance()),
        };
        let r = noise::unit(seed, 90, id);
        at_secs += u.utterance.duration_secs + if r < 0.1 { 4.0 + 10.0 * r } else { 0.2 + r };
        all.push(u);
    }
    all
}

/// An utterance while it is made.
struct Maker {
    seed: u64,
    id: i64,
    count: i64,
    now_secs: f64,
    u: Utterance,
    /// Middle of each accent.
    hills: Vec<f64>,
    /// Start of each phrase.
    falls: Vec<f64>,
}

impl Maker {
    fn new(seed: u64, id: i64) -> Self {
        Self {
            seed,
            id,
            count: 0,
            now_secs: 0.0,
            u: Utterance::default(),
            hills: Vec::new(),
            falls: Vec::new(),
        }
    }

    fn unit(&mut self) -> f64 {
        self.count += 1;
        noise::unit(self.seed ^ (self.id as u64) << 20, 91, self.count)
    }

    fn phone(&mut self, symbol: &str, secs: f64, word: Option<usize>) {
        // Bundles specify times in milliseconds.
        let end_secs = ((self.now_secs + secs) * 1000.0).round() / 1000.0;
        let phone = Phone::new(symbol, self.now_secs, end_secs, word);
        self.u.phones.push(phone);
        self.now_secs = end_secs;
    }

    fn utterance(mut self) -> Utterance {
        self.phone("pau", 0.12, None);
        let sentences = 1 + (self.unit() * 3.0) as usize;
        for s in 0..sentences {
            if s > 0 {
                let secs = 0.35 + 0.4 * self.unit();
                self.phone("pau", secs, None);
            }
            self.sentence();
        }
        self.phone("pau", 0.15, None);
        self.u.duration_secs = self.now_secs;
        self.measure();
        self.u
    }

    fn sentence(&mut self) {
        let first_word = self.u.words.len();
        let phrases = 1 + (self.unit() * 3.0) as usize;
        for p in 0..phrases {
            if p > 0 && self.unit() < 0.7 {
                let secs = 0.18 + 0.3 * self.unit();
                self.phone("pau", secs, None);
            }
            let first_word = self.u.words.len();
            self.falls.push(self.now_secs);
            let words = 2 + (self.unit() * 5.0) as usize;
            for w in 0..words {
                if w > 0 && self.unit() < 0.02 {
                    let secs = 0.8 + self.unit();
                    self.phone("pau", secs, None);
                }
                self.word();
            }
            self.u.phrases.push(Phrase {
                first_word,
                words,
                tone: "L-L%".to_owned(),
            });
        }
        let kind = if self.unit() < 0.08 {
            SentenceKind::Question
        } else {
            SentenceKind::Statement
        };
        let words = self.u.words.len() - first_word;
        self.u.sentences.push(Sentence {
            first_word,
            words,
            kind,
        });
    }

    fn word(&mut self) {
        let (word, start_secs) = (self.u.words.len(), self.now_secs);
        let is_accented = self.unit() < 0.45;
        for s in 0..1 + (self.unit() * 3.0) as usize {
            let first_phone = self.u.phones.len();
            let consonant = ["s", "m", "t", "l", "p"][(self.unit() * 5.0) as usize];
            let secs = 0.05 + 0.05 * self.unit();
            self.phone(consonant, secs, Some(word));
            let secs = 0.06 + 0.06 * self.unit() + if is_accented && s == 0 { 0.05 } else { 0.0 };
            self.phone("aa", secs, Some(word));
            if is_accented && s == 0 {
                self.hills.push(self.now_secs - 0.5 * secs);
                self.u.accents.push(Accent {
                    syllable: self.u.syllables.len(),
                    label: "H*".to_owned(),
                });
                self.u.syllables.push(Syllable {
                    first_phone,
                    phones: 2,
                    stress: 1,
                });
            }
        }
        self.u.words.push(Word {
            text: "word".to_owned(),
            start_secs,
            end_secs: self.now_secs,
            emphasized: false,
        });
    }

    /// A voice that falls through each phrase, with a hill on each accent, and the level of
    /// its phones.
    fn measure(&mut self) {
        let frames = (self.u.duration_secs * 100.0) as usize;
        let mut phone = 0;
        for i in 0..frames {
            let t = i as f64 * 0.01;
            while self.u.phones[phone].end_secs <= t {
                phone += 1;
            }
            let fall = self.falls.iter().rev().find(|start| **start <= t);
            let fall = fall.map_or(0.0, |start| 2.0 * ops::exp(-(t - start)));
            let hill = |at: &f64| 4.0 * ops::exp(-(t - at) * (t - at) / 0.012);
            let tones = fall + self.hills.iter().map(hill).sum::<f64>();
            let hz = 110.0 * ops::exp(tones / 12.0 * core::f64::consts::LN_2);
            let (voiced, db) = match self.u.phones[phone].symbol.as_str() {
                "aa" => (true, -18.0 + tones),
                "m" | "l" => (true, -26.0),
                "pau" => (false, -90.0),
                _ => (false, -35.0),
            };
            self.u.f0.push(if voiced { code_of_hz(hz) } else { 0 });
            self.u.intensity.push(code_of_db(db));
        }
    }
}

/// The speech of all shipped stories, one behind the other.
pub(crate) fn shipped() -> Vec<TimedUtterance> {
    let stories = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../assets/stories");
    let mut all = Vec::new();
    let mut at_secs = 1.0;
    for name in [
        "hello-world",
        "white-rabbit",
        "step-lesson",
        "virtual-poets/jabberwocky",
        "virtual-poets/os-lusiadas",
        "virtual-poets/the-road-not-taken",
        "virtual-poets/zwei-parallelen",
    ] {
        let json = std::fs::read(stories.join(name).join("voice/speech.json")).unwrap();
        let bundle = Bundle::from_json(&json).unwrap();
        for u in &bundle.utterances {
            all.push(TimedUtterance {
                start_secs: at_secs,
                utterance: Arc::clone(u),
            });
            at_secs += u.duration_secs + 0.3;
        }
        at_secs += 5.0;
    }
    all
}
