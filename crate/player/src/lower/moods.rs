//! Music for a mood (GEVH 3.5.4.3): a piece by valence, the voices added by arousal, and the
//! transitions between pieces. An author's own pieces may also depend on arousal.

use raconteur_eml::{Arousal, ControlSource, Document};
use raconteur_stage::emotion::Valence;
use raconteur_stage::{EmotionTimeline, Mood};

use crate::lower::music_stem::{MusicClause, MusicStem};
use crate::lower::repertoire::Repertoire;

/// Minimum duration of mood music, seconds. Designed.
const MIN_SECS: f64 = 8.0;
/// Cross-fade between pieces, seconds, on a bar line. Designed.
const FADE_SECS: f64 = 2.0;
/// Volume of mood music relative to its recording: it stays behind the story. Designed.
const VOLUME: f64 = 0.8;
/// Sampling interval of the mood, seconds, and the maximum number of samples.
const STEP_SECS: f64 = 0.5;
const MAX_STEPS: f64 = 20_000.0;
/// Share of its onset bound to which a mood must fall back before its music ends. Designed.
const LETS_GO: f64 = 0.7;
/// Maximum number of pieces of a script; there are six moods, and the limit bounds the work.
const MAX_OWN_PIECES: usize = 12;
/// A smaller change of a voice's level is not written.
const MIN_CHANGE: f64 = 0.03;

/// Converts the valence of a script to that of the mood.
pub(crate) fn of_script(valence: raconteur_eml::Valence) -> Valence {
    match valence {
        raconteur_eml::Valence::Negative => Valence::Negative,
        raconteur_eml::Valence::Neutral => Valence::Neutral,
        raconteur_eml::Valence::Positive => Valence::Positive,
    }
}

/// Piece of music provided by the author for a mood.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OwnPiece {
    valence: Valence,
    /// Arousal; `None` matches any.
    is_aroused: Option<bool>,
    file: String,
    bar_secs: f64,
}

/// Returns the pieces of a script.
pub(crate) fn own_pieces(document: &Document) -> Vec<OwnPiece> {
    let pieces = document.environment.iter().flat_map(|e| &e.pieces);
    pieces
        .take(MAX_OWN_PIECES)
        .map(|piece| OwnPiece {
            valence: of_script(piece.valence),
            is_aroused: piece.arousal.map(|a| a == Arousal::High),
            file: piece.file.clone(),
            bar_secs: piece.bar_secs,
        })
        .collect()
}

/// The mood that a piece is for.
type Tone = (Valence, bool);

/// Returns the tone of a mood after another: with hysteresis, so a tone ends only after the mood
/// has fallen back.
fn tone(mood: &Mood, before: Option<Tone>) -> Tone {
    let held = |scale: f64| Mood {
        valence: mood.valence / scale,
        arousal: mood.arousal / scale,
    };
    let (valence, is_aroused) = (mood.sign(), mood.is_aroused());
    let Some((was, was_aroused)) = before else {
        return (valence, is_aroused);
    };
    let stays = valence == Valence::Neutral && held(LETS_GO).sign() == was;
    let stays_aroused = was_aroused && held(LETS_GO).is_aroused();
    (
        if stays { was } else { valence },
        is_aroused || stays_aroused,
    )
}

/// Music driven by moods: emotions, pieces of the library and of the author, and the end of the
/// performance.
pub(crate) struct MoodMusic<'a> {
    pub(crate) emotions: &'a EmotionTimeline,
    pub(crate) repertoire: Repertoire,
    pub(crate) own: &'a [OwnPiece],
    /// True if moods control the music initially.
    pub(crate) follows: bool,
    pub(crate) end_secs: f64,
}

impl MoodMusic<'_> {
    /// Returns the music of a performance by time: the script's, and the mood's where the script
    /// does not control it. A story without emotion has no mood music.
    pub(crate) fn music(&self, script: Vec<MusicClause>) -> Vec<MusicClause> {
        if self.emotions.all().is_empty() {
            return script
                .into_iter()
                .filter(|c| c.by == ControlSource::Script)
                .collect();
        }
        let mut led = Vec::new();
        let mut from_secs = self.follows.then_some(0.0);
        for clause in script {
            if let Some(from) = from_secs.take_if(|_| clause.by == ControlSource::Script) {
                self.follow(from, clause.start_secs, &mut led);
            }
            if clause.by == ControlSource::Script {
                led.push(clause);
            } else {
                from_secs.get_or_insert(clause.start_secs);
            }
        }
        if let Some(from) = from_secs {
            // It has faded when the story is over.
            let fades_secs = (self.end_secs - FADE_SECS).max(from);
            self.follow(from, fades_secs, &mut led);
            led.push(MusicClause::silence(fades_secs, FADE_SECS));
        }
        led
    }

    /// Adds the music that follows the mood from one time to another.
    fn follow(&self, from_secs: f64, to_secs: f64, led: &mut Vec<MusicClause>) {
        let step_secs = STEP_SECS.max((to_secs - from_secs) / MAX_STEPS);
        let mut now = tone(&self.emotions.mood(from_secs), None);
        let mut begun_secs = from_secs;
        let mut t = from_secs;
        while t < to_secs {
            t += step_secs;
            let next = tone(&self.emotions.mood(t), Some(now));
            if self.bar(next) == self.bar(now) || t < begun_secs + MIN_SECS {
                continue;
            }
            let bar_secs = self.bar(now).1;
            let bars = ((t - begun_secs) / bar_secs).ceil();
            let at_secs = begun_secs + bars * bar_secs;
            if at_secs >= to_secs {
                break;
            }
            led.push(self.clause(now, begun_secs, at_secs));
            (now, begun_secs, t) = (next, at_secs, at_secs);
        }
        if begun_secs < to_secs {
            led.push(self.clause(now, begun_secs, to_secs));
        }
    }

    fn own_piece(&self, (valence, is_aroused): Tone) -> Option<&OwnPiece> {
        let fits = |p: &&OwnPiece| {
            p.valence == valence && p.is_aroused.is_none_or(|aroused| aroused == is_aroused)
        };
        self.own.iter().find(fits)
    }

    /// Returns the file of a tone's piece, and the length of its bars, seconds.
    fn bar(&self, tone: Tone) -> (&str, f64) {
        match self.own_piece(tone) {
            Some(own) => (&own.file, own.bar_secs.max(0.05)),
            None => {
                let piece = self.repertoire.piece(tone.0);
                (piece.name, piece.bar_secs)
            }
        }
    }

    /// Returns the music for a mood from one time to another.
    fn clause(&self, tone: Tone, from_secs: f64, to_secs: f64) -> MusicClause {
        let voices = match self.own_piece(tone) {
            Some(own) => vec![MusicStem {
                file: own.file.clone(),
                library: false,
                loops: true,
                share: Vec::new(),
            }],
            None => {
                let rise = self.rise(from_secs, to_secs + FADE_SECS);
                self.repertoire.piece(tone.0).voices(rise)
            }
        };
        MusicClause {
            start_secs: from_secs,
            by: ControlSource::Emotion,
            voices,
            volume: VOLUME,
            fade_secs: FADE_SECS,
        }
    }

    /// Returns the level of the additional stems of arousal, from one time to another.
    fn rise(&self, from_secs: f64, to_secs: f64) -> Vec<(f64, f64)> {
        let step_secs = STEP_SECS.max((to_secs - from_secs) / MAX_STEPS);
        let mut line: Vec<(f64, f64)> = Vec::new();
        let mut t = from_secs;
        while t < to_secs + step_secs {
            let share = self.emotions.mood(t).activity();
            if line
                .last()
                .is_none_or(|(_, l)| (l - share).abs() >= MIN_CHANGE)
            {
                // Straight from where it was before, not from long ago.
                if let Some(&(at, level)) = line.last().filter(|(at, _)| t - at > step_secs) {
                    line.push(((t - step_secs).max(at), level));
                }
                line.push((t, share));
            }
            t += step_secs;
        }
        line
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_stage::{EmotionEnvelope, EmotionType};

    const REPERTOIRE: Repertoire = Repertoire::new(3);

    fn named(valence: Valence) -> String {
        format!("{}.opus", REPERTOIRE.piece(valence).name)
    }

    fn felt(kind: &str, start_secs: f64, potential: f64, activation: f64) -> EmotionEnvelope {
        EmotionEnvelope {
            kind: EmotionType::named(kind).expect(kind),
            potential,
            intensity: potential,
            activation,
            start_secs,
            apex_secs: start_secs + 0.6,
            until_secs: start_secs + 8.0,
            end_secs: start_secs + 12.0,
        }
    }

    fn scored(
        felt: Vec<EmotionEnvelope>,
        own: &[OwnPiece],
        script: Vec<MusicClause>,
    ) -> Vec<(f64, String)> {
        let feelings = EmotionTimeline::new(felt);
        let scoring = MoodMusic {
            emotions: &feelings,
            repertoire: REPERTOIRE,
            own,
            follows: true,
            end_secs: 90.0,
        };
        let led = scoring.music(script).into_iter();
        led.map(|c| {
            let file = c
                .voices
                .first()
                .map_or_else(String::new, |v| v.file.clone());
            (c.start_secs, file)
        })
        .collect()
    }

    #[test]
    fn moods_change_the_piece_on_bar_lines_and_not_soon() {
        let feelings = vec![felt("joy", 10.0, 6.0, 0.3), felt("anger", 30.0, 8.0, 0.6)];
        let led = scored(feelings, &[], Vec::new());
        let names: Vec<&str> = led.iter().map(|(_, file)| &**file).collect();
        let [good, bad] = [Valence::Positive, Valence::Negative].map(named);
        assert_eq!(names[0], named(Valence::Neutral));
        assert!(
            names.contains(&&*good) && names.contains(&&*bad),
            "{names:?}"
        );
        assert_eq!(names.last(), Some(&""), "it ends with the story");
        for pair in led.windows(2).filter(|p| !p[1].1.is_empty()) {
            let [(a, file), (b, _)] = pair else { continue };
            assert!(b - a >= MIN_SECS, "{led:?}");
            let valences = [Valence::Negative, Valence::Neutral, Valence::Positive];
            let of_file = valences.into_iter().find(|v| named(*v) == *file);
            let piece = REPERTOIRE.piece(of_file.expect(file));
            let bars = (b - a) / piece.bar_secs;
            assert!((bars - bars.round()).abs() < 1e-6, "{led:?}");
        }
    }

    #[test]
    fn arousal_changes_an_authors_piece_and_only_the_voices_of_those_of_the_library() {
        // Both are bad, the second is active.
        let feelings = || {
            vec![
                felt("distress", 2.0, 8.0, 0.0),
                felt("anger", 14.0, 8.0, 1.0),
            ]
        };
        let bad = named(Valence::Negative);
        let led = scored(feelings(), &[], Vec::new());
        assert_eq!(
            led.iter().filter(|(_, file)| *file == bad).count(),
            1,
            "{led:?}"
        );
        let own = [(false, "calm.opus"), (true, "wild.opus")].map(|(is_aroused, file)| OwnPiece {
            valence: Valence::Negative,
            is_aroused: Some(is_aroused),
            file: file.to_owned(),
            bar_secs: 2.0,
        });
        let led = scored(feelings(), &own, Vec::new());
        for file in ["calm.opus", "wild.opus"] {
            assert!(led.iter().any(|(_, f)| f == file), "{led:?}");
        }
        assert!(led.iter().all(|(_, file)| *file != bad), "{led:?}");
    }

    #[test]
    fn nothing_felt_is_silent_and_an_author_brings_other_pieces() {
        assert_eq!(scored(Vec::new(), &[], Vec::new()), []);
        let own = [OwnPiece {
            valence: Valence::Neutral,
            is_aroused: None,
            file: "music/own.opus".to_owned(),
            bar_secs: 2.0,
        }];
        let led = scored(vec![felt("hope", 60.0, 0.5, 0.0)], &own, Vec::new());
        assert_eq!(led[0], (0.0, "music/own.opus".to_owned()));
        let quiet = MusicClause::silence(20.0, 1.0);
        let script = MusicClause {
            by: ControlSource::Script,
            ..quiet
        };
        let led = scored(vec![felt("hope", 60.0, 0.5, 0.0)], &own, vec![script]);
        assert_eq!(led.last(), Some(&(20.0, String::new())));
        assert_eq!(led.len(), 2);
    }
}
