//! Music of a performance (GEVH 3.5.4.3): the pieces, their times and their volume.
//!
//! The volume is piecewise linear over story time. It includes the volume attribute, the fades and
//! the ducking under speech, so a page that plays it needs no rule.

use raconteur_base::order::sort_by_number;
use raconteur_eml::ClauseKind;

use crate::lower::cues::UtteranceCue;
use crate::lower::moods;
use crate::lower::music_stem::{MusicClause, MusicStem};
use crate::lower::script::Script;

/// Share of the music's level under speech: 8 dB less. Designed: words stay clear
/// over music that is as loud as they are.
const UNDER_SPEECH: f64 = 0.4;
/// Lead of the music's ducking before a word, and its recovery after the last word, seconds.
/// Designed.
const STEP_BACK_SECS: f64 = 0.3;
const RETURN_SECS: f64 = 0.9;
/// Shortest fade, seconds, which prevents clicks at abrupt starts and ends.
const CLICK_SECS: f64 = 0.01;

/// Piece of music with its times and level; the page plays it.
#[derive(Clone, Debug, PartialEq)]
pub struct MusicCue {
    /// Story time at which the piece begins, seconds.
    pub start_secs: f64,
    /// Story time at which it is silent, seconds; infinite if nothing ends it.
    pub end_secs: f64,
    /// Path of its file, relative to the story's folder or to the folder `music` of the asset
    /// library, and inside that folder. An `.opus` may be accompanied by an `.mp3`.
    pub file: String,
    /// True if it is from the library.
    pub library: bool,
    /// True if it repeats.
    pub loops: bool,
    /// Level at story times (seconds), in order; 1 is as recorded. It is linear between them and
    /// constant outside.
    pub level: Vec<(f64, f64)>,
}

/// Returns the music clauses of a script, sorted by time.
pub(crate) fn clauses(script: &Script) -> Vec<MusicClause> {
    let clauses = script.timeline.clauses.iter();
    clauses
        .filter_map(|timed| match &script.document.clause(timed.clause).kind {
            ClauseKind::Music(music) => {
                let own = music.file.as_ref().map(|file| MusicStem {
                    file: file.clone(),
                    library: false,
                    loops: false,
                    share: Vec::new(),
                });
                let voices = match (own, music.valence) {
                    (Some(own), _) => vec![own],
                    (None, Some(valence)) => {
                        let piece = script.repertoire.piece(moods::of_script(valence));
                        piece.voices(Vec::new())
                    }
                    (None, None) => Vec::new(),
                };
                Some(MusicClause {
                    start_secs: timed.start_secs,
                    by: music.by,
                    voices,
                    volume: music.volume,
                    fade_secs: music.fade_secs.max(CLICK_SECS),
                })
            }
            _ => None,
        })
        .collect()
}

/// Returns the audible pieces sorted by time, from clauses sorted by time, with levels lowered
/// under all utterances.
pub(crate) fn cues<'a>(
    clauses: &[MusicClause],
    utterances: impl Iterator<Item = &'a UtteranceCue>,
) -> Vec<MusicCue> {
    let mut spoken: Vec<(f64, f64)> = utterances
        .map(|u| (u.timed.start_secs, u.timed.end_secs()))
        .collect();
    sort_by_number(&mut spoken, |s| s.0);
    // Between two sentences close to each other it stays back.
    spoken.dedup_by(|next, last| {
        let close = next.0 - last.1 < STEP_BACK_SECS + RETURN_SECS;
        if close {
            last.1 = last.1.max(next.1);
        }
        close
    });
    let mut cues = Vec::new();
    for (i, clause) in clauses.iter().enumerate() {
        let next = clauses.get(i + 1);
        let over = next.map_or((f64::INFINITY, f64::INFINITY), |n| {
            (n.start_secs, n.start_secs + n.fade_secs)
        });
        for voice in &clause.voices {
            cues.push(cue(clause, voice, over, &spoken));
        }
    }
    cues
}

/// Returns the cue of a clause's stem between two times, ducked under speech.
fn cue(
    clause: &MusicClause,
    voice: &MusicStem,
    over: (f64, f64),
    spoken: &[(f64, f64)],
) -> MusicCue {
    let fade_in = (clause.start_secs, clause.start_secs + clause.fade_secs);
    let bends = spoken.iter().flat_map(|&(from, to)| {
        let [back, there] = [from - STEP_BACK_SECS, to + RETURN_SECS];
        [back, from, to, there]
    });
    let mut times: Vec<f64> = [fade_in.0, fade_in.1, over.0, over.1]
        .into_iter()
        .chain(bends)
        .chain(voice.share.iter().map(|(t, _)| *t))
        .filter(|t| t.is_finite() && (fade_in.0..=over.1).contains(t))
        .collect();
    sort_by_number(&mut times, |t| *t);
    times.dedup();
    let level = |t: f64| {
        // Utterances are so far apart that only the last started one counts.
        let begun = spoken.partition_point(|s| s.0 - STEP_BACK_SECS <= t);
        let under = begun.checked_sub(1).map_or(0.0, |i| {
            let (from, to) = spoken[i];
            ramp(t, from - STEP_BACK_SECS, from) * (1.0 - ramp(t, to, to + RETURN_SECS))
        });
        let fades = ramp(t, fade_in.0, fade_in.1) * (1.0 - ramp(t, over.0, over.1));
        let share = on_line(&voice.share, t).unwrap_or(1.0);
        clause.volume * fades * share * (1.0 - under * (1.0 - UNDER_SPEECH))
    };
    MusicCue {
        start_secs: clause.start_secs,
        end_secs: over.1,
        file: voice.file.clone(),
        library: voice.library,
        loops: voice.loops,
        level: times.into_iter().map(|t| (t, level(t))).collect(),
    }
}

/// Interpolates a polyline of points by time; `None` without points.
fn on_line(line: &[(f64, f64)], time_secs: f64) -> Option<f64> {
    let after = line.partition_point(|(t, _)| *t <= time_secs);
    let before = after.checked_sub(1).and_then(|i| line.get(i));
    match (before, line.get(after)) {
        (Some(&(t0, a)), Some(&(t1, b))) => Some(a + (b - a) * ramp(time_secs, t0, t1)),
        (Some(&(_, only)), None) | (None, Some(&(_, only))) => Some(only),
        (None, None) => None,
    }
}

/// Returns a linear ramp: 0 at time `from`, 1 at a later time `to`.
fn ramp(t: f64, from: f64, to: f64) -> f64 {
    if from.is_infinite() {
        return 0.0;
    }
    ((t - from) / (to - from)).clamp(0.0, 1.0)
}

impl MusicCue {
    /// Returns the level at a story time, seconds; 0 before the piece begins and after it ends.
    #[must_use]
    pub fn level_at(&self, time_secs: f64) -> f64 {
        if !(self.start_secs..self.end_secs).contains(&time_secs) {
            return 0.0;
        }
        on_line(&self.level, time_secs).unwrap_or(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn music(body: &str) -> Vec<MusicCue> {
        let text = format!("<eml xmlns:r='urn:raconteur:eml:1'><body>{body}</body></eml>");
        let script = Script::read(&text, None);
        let utterances = crate::lower::cues::utterances(&script);
        cues(&clauses(&script), utterances.iter())
    }

    #[test]
    fn a_piece_fades_in_and_makes_room_for_the_next() {
        let cues = music(
            "<r:music time='1' file='a.opus' volume='0.5' fade='2'/>\
             <r:music time='10' valence='negative' fade='4'/><r:music time='20'/>",
        );
        let names: Vec<_> = cues.iter().map(|c| (c.file.as_str(), c.library)).collect();
        assert_eq!(
            names,
            [
                ("a.opus", false),
                ("negative-calm.opus", true),
                ("negative-calm-rise.opus", true)
            ]
        );
        let [a, b] = [&cues[0], &cues[1]];
        let levels = [0.5, 1.0, 2.0, 3.0, 9.0, 12.0, 14.0].map(|t| a.level_at(t));
        assert_eq!(levels, [0.0, 0.0, 0.25, 0.5, 0.5, 0.25, 0.0]);
        let levels = [9.0, 12.0, 14.0, 19.9, 20.01].map(|t| b.level_at(t));
        assert_eq!(levels, [0.0, 0.5, 1.0, 1.0, 0.0]);
        assert_eq!((a.end_secs, b.end_secs), (14.0, 20.0 + CLICK_SECS));
    }

    #[test]
    fn music_steps_back_while_somebody_speaks() {
        let cues = music(
            "<r:music time='0' file='a.opus'/><voice-text time='4' timeId='s'>Now we march.\
             </voice-text><null time='30'/>",
        );
        let piece = &cues[0];
        assert_eq!(piece.level_at(4.0 - STEP_BACK_SECS), 1.0);
        assert_eq!(piece.level_at(4.0), UNDER_SPEECH);
        assert_eq!(piece.level_at(4.2), UNDER_SPEECH);
        assert_eq!(piece.level_at(29.0), 1.0);
        assert_eq!(piece.end_secs, f64::INFINITY);
        // It never jumps: 20 ms change it by no more than the steepest ramp but the fade in.
        for i in 1..1400 {
            let t = 0.02 * f64::from(i);
            let step = (piece.level_at(t + 0.02) - piece.level_at(t)).abs();
            assert!(
                step <= 0.02 * (1.0 - UNDER_SPEECH) / STEP_BACK_SECS + 1e-9,
                "{t}"
            );
        }
    }
}
