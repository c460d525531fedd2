//! Key of a clause's utterance in a bundle: a digest of the words, their markup, the voice, the
//! emotion and the tension. It excludes the position and the spelling of tags, so that a story may
//! be rearranged and reformatted without another bake.

use raconteur_eml::{ClauseKind, Level, Markup, TextSegment, VoiceSay, VoiceText};

use crate::SpokenClause;

/// FNV-1a, 64 bits.
struct Hash(u64);

impl Hash {
    fn bytes(&mut self, bytes: &[u8]) {
        for byte in bytes {
            self.0 ^= u64::from(*byte);
            self.0 = self.0.wrapping_mul(0x0100_0000_01b3);
        }
    }

    /// Adds a text and an end marker to the digest.
    fn text(&mut self, text: &str) {
        self.bytes(text.as_bytes());
        self.bytes(&[0xff]);
    }

    fn optional(&mut self, text: Option<&str>) {
        self.text(text.unwrap_or("\u{1}"));
    }

    fn number(&mut self, number: f64) {
        // Minus zero is zero.
        self.bytes(&(number + 0.0).to_bits().to_le_bytes());
    }

    fn level(&mut self, level: &Level) {
        match *level {
            Level::Word(word) => self.text(word),
            Level::Percent(percent) => {
                self.bytes(b"%");
                self.number(percent);
            }
            Level::Number(number) => self.number(number),
        }
    }

    fn levels(&mut self, levels: &[Option<Level>]) {
        for level in levels {
            self.bytes(&[0xfd]);
            if let Some(level) = level {
                self.level(level);
            }
        }
    }
}

/// Returns the key of a clause's speech.
pub(super) fn key_of(spoken: &SpokenClause<'_>) -> u64 {
    let mut hash = Hash(0xcbf2_9ce4_8422_2325);
    hash.optional(spoken.voice);
    if let Some(emotion) = spoken.emotion {
        hash.text(emotion.kind.map_or("", raconteur_eml::EmotionKind::word));
        hash.number(emotion.intensity());
        // Absent attributes add nothing, so that a word alone keeps its key.
        let given = [emotion.activation, emotion.evaluation, emotion.power];
        for (sign, value) in (0xf5..).zip(given) {
            if let Some(value) = value {
                hash.bytes(&[sign]);
                hash.number(value);
            }
        }
    }
    // The same for the tension.
    if let Some(tension) = spoken.tension {
        hash.bytes(&[0xf4]);
        hash.number(tension);
    }
    match spoken.kind {
        ClauseKind::VoiceText(text) => voice_text(&mut hash, text),
        ClauseKind::VoiceSay(say) => voice_say(&mut hash, say),
        _ => {}
    }
    hash.0
}

/// Hashes a voice-say; plain text gives the same hash for either element.
fn voice_say(hash: &mut Hash, say: &VoiceSay) {
    let text = say.text();
    if text.pieces.is_empty() {
        hash.text(say.kind.word());
        hash.bytes(&[
            0xfc,
            u8::from(say.is_file()),
            u8::from(say.is_resources_relative),
        ]);
        hash.text(&say.content);
    } else {
        voice_text(hash, &text);
    }
}

fn voice_text(hash: &mut Hash, voice: &VoiceText) {
    // White space between two words is one space, however much there is.
    let (mut begun, mut parted) = (false, false);
    for piece in &voice.pieces {
        // Each kind of piece has a byte that occurs in no text.
        match piece {
            TextSegment::Text { text, .. } => {
                for byte in text.bytes() {
                    if matches!(byte, b' ' | b'\t' | b'\n' | b'\r') {
                        parted = begun;
                    } else {
                        if parted {
                            hash.bytes(b" ");
                        }
                        (begun, parted) = (true, false);
                        hash.bytes(&[byte]);
                    }
                }
                continue;
            }
            TextSegment::Mark { .. } | TextSegment::Marker { .. } => continue,
            TextSegment::Break { msec, boundary, .. } => {
                hash.bytes(&[0xf8]);
                hash.bytes(&msec.to_le_bytes());
                hash.optional(boundary.map(raconteur_eml::Boundary::word));
            }
            TextSegment::Audio { audio, .. } => {
                hash.bytes(&[0xf9]);
                hash.text(&audio.src);
                hash.text(audio.mode.word());
                hash.number(audio.level);
            }
            TextSegment::DivStart { kind, .. } => {
                hash.bytes(&[0xfa, kind.map_or(0, |k| k as u8 + 1)]);
            }
            TextSegment::DivEnd => hash.bytes(&[0xfb]),
            // Words may continue across these elements, so adjacent white space counts.
            TextSegment::Start { markup, .. } => {
                hash.bytes(&[0xfe, u8::from(parted)]);
                hash.text(markup.name());
                fields(hash, markup);
                parted = false;
                continue;
            }
            TextSegment::End => {
                hash.bytes(&[0xfd, u8::from(parted)]);
                parted = false;
                continue;
            }
        }
        (begun, parted) = (false, false);
    }
}

fn fields(hash: &mut Hash, markup: &Markup) {
    match markup {
        Markup::Emph(emph) => hash.level(&emph.level),
        Markup::Engine(engine) => {
            hash.text(&engine.id);
            hash.text(&engine.data);
        }
        Markup::Pitch(pitch) => hash.levels(&[pitch.base, pitch.middle, pitch.range]),
        Markup::Pron(pron) => {
            for text in [&pron.ipa, &pron.sub, &pron.origin] {
                hash.optional(text.as_deref());
            }
        }
        Markup::Rate(rate) => hash.level(&rate.speed),
        Markup::SayAs(say) => {
            hash.text(say.mode.word());
            hash.optional(say.mode_type.map(raconteur_eml::SayAsType::word));
        }
        Markup::Volume(volume) => hash.level(&volume.level),
        Markup::Language(language) => hash.text(&language.id),
        Markup::Speaker(speaker) => {
            hash.optional(speaker.gender.map(raconteur_eml::Gender::word));
            hash.optional(speaker.age.map(raconteur_eml::Age::word));
            hash.optional(speaker.name.as_deref());
        }
    }
}

#[cfg(test)]
mod tests {
    use raconteur_eml::parse;

    use crate::{SpokenClause, spoken_clauses};

    fn keys(body: &str) -> Vec<u64> {
        let source = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let document = parse(&source).document;
        let spoken = spoken_clauses(&document);
        spoken.iter().map(SpokenClause::key).collect()
    }

    fn key(inner: &str) -> u64 {
        keys(&format!("<voice-text time='0'>{inner}</voice-text>"))[0]
    }

    #[test]
    fn spelling_does_not_change_a_key() {
        let same = [
            "Hello <emph>big</emph> world",
            "\n  Hello \t <emph level='moderate'>big</emph>\n world  ",
            "Hello <tm name='x'/><emph>big</emph><!-- c --> wo<tm name='y'/>rld",
            "<!-- c -->Hello <emph  level=\"moderate\" >big</emph> w&#111;rld",
        ];
        for inner in same {
            assert_eq!(key(inner), key(same[0]), "{inner}");
        }
    }

    #[test]
    fn what_is_heard_differently_has_another_key() {
        let different = [
            "Hello big world",
            "Hello <emph>big</emph> world",
            "Hello <emph level='strong'>big</emph> world",
            "Hello <emph>big world</emph>",
            "Hello<emph>big</emph> world",
            "Hello <emph>big</emph>world",
            "Hello big, world",
            "Hello big <break/>world",
            "Hello big <break msec='1'/>world",
            "Hello big <break type='?'/>world",
            "<div>Hello big world</div>",
            "<div type='paragraph'>Hello big world</div>",
            "Hello <pitch base='10%'>big</pitch> world",
            "Hello <pitch base='10'>big</pitch> world",
            "Hello <pitch middle='10%'>big</pitch> world",
            "Hello <rate speed='10%'>big</rate> world",
            "Hello <volume level='10%'>big</volume> world",
            "Hello <pron sub='a'>big</pron> world",
            "Hello <pron ipa='a'>big</pron> world",
            "Hello <sayas mode='name'>big</sayas> world",
            "Hello <engine id='a' data='b'>big</engine> world",
            "Hello <audio src='a.wav'/> big world",
        ];
        let keys: std::collections::BTreeSet<u64> =
            different.iter().map(|inner| key(inner)).collect();
        assert_eq!(keys.len(), different.len());
    }

    #[test]
    fn voice_emotion_and_source_count() {
        let all = keys(
            "<voice-text time='0'>Hello</voice-text>\
             <voice-say time='0' voiceOperation='text'>Hello</voice-say>\
             <voice-say time='0' voiceOperation='text' type='sable'>Hello</voice-say>\
             <voice-say time='0' voiceOperation='file'>Hello</voice-say>\
             <voice-change time='0' voice='kal'/><voice-text time='0'>Hello</voice-text>\
             <r:emotion time='0' type='joy'/><voice-text time='0'>Hello</voice-text>\
             <r:emotion time='0' type='joy' power='9'/><voice-text time='0'>Hello</voice-text>\
             <r:emotion time='0' type='joy' space='disc'/><voice-text time='0'>Hello</voice-text>\
             <r:emotion time='0' activation='9'/><voice-text time='0'>Hello</voice-text>\
             <r:emotion time='0' evaluation='9'/><voice-text time='0'>Hello</voice-text>\
             <r:emotion time='0' type='neutral'/><voice-text time='0'>Hello</voice-text>",
        );
        assert_eq!(all[0], all[1]);
        assert_eq!(all[4], all[10]);
        // Voices know no space.
        assert_eq!(all[5], all[7]);
        let different: std::collections::BTreeSet<u64> = all.iter().copied().collect();
        assert_eq!(different.len(), 8);
    }
}
