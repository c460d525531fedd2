//! Parsed story: its document, its times and its voice, independent of the performer.

use std::sync::Arc;

use raconteur_actor::Library;
use raconteur_eml::{
    ClauseId, ClauseKind, Diagnostic, Document, Parsed, Performer, RunUp, Span, Timeline, parse,
    thinned,
};
use raconteur_speech::bundle::Voice;
use raconteur_speech::{Bundle, Utterance};

use crate::lower::repertoire::Repertoire;
use crate::lower::requirements::Requirements;
use crate::lower::voice::{KnownDurations, Voices};
use crate::options::{LanguageTag, Options};

/// Script with everything resolved that does not depend on the figure: document, timeline, speech
/// and diagnostics.
#[derive(Clone, Debug)]
pub struct Script {
    /// Parsed EML document.
    pub document: Document,
    /// Times of all clauses.
    pub timeline: Timeline,
    /// Problems found in the script and its speech bundle.
    pub diagnostics: Vec<Diagnostic>,
    /// The speech, where it was baked.
    pub(crate) bundle: Option<Arc<Bundle>>,
    /// Earliest time at which hands are at the first place of a stroke, story time, seconds.
    pub(crate) hands_from_secs: f64,
    /// Delay of the whole script because hands must reach their start, seconds.
    pub waits_secs: f64,
    /// Utterances of the clauses.
    voices: Voices,
    /// Default language.
    pub(crate) page_language: Option<LanguageTag>,
    /// The library's pieces of music that are played.
    pub(crate) repertoire: Repertoire,
}

/// Stage of loading a story, reported as progress so that a page can name the stage that failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoadStage {
    /// The script's text.
    Story,
    /// The JSON of the speech bundle.
    Speech,
    /// The plans of the performance.
    Performance,
}

/// Sources of a script's durations in addition to its text: speech bundle and animation library.
pub(crate) struct TimingSources<'a> {
    pub(crate) bundle: Option<Arc<Bundle>>,
    pub(crate) library: &'a Library,
}

impl Script {
    /// Reads a script and, if given, the JSON of its speech bundle. Never fails: problems are in
    /// [`Script::diagnostics`], and the rest plays.
    #[must_use]
    pub fn read(eml: &str, bundle_json: Option<&[u8]>) -> Self {
        Self::read_with_progress(eml, bundle_json, &mut |_| ())
    }

    /// Reads a script like [`Script::read`] and calls `progress` as each stage begins.
    pub(crate) fn read_with_progress(
        eml: &str,
        bundle_json: Option<&[u8]>,
        progress: &mut dyn FnMut(LoadStage),
    ) -> Self {
        progress(LoadStage::Story);
        let mut parsed = parse(eml);
        if bundle_json.is_some() {
            progress(LoadStage::Speech);
        }
        let bundle = bundle_json.and_then(|json| match Bundle::from_json(json) {
            Ok(bundle) => Some(Arc::new(bundle)),
            Err(error) => {
                parsed.diagnostics.push(
                    Diagnostic::error(
                        "player::bad-bundle",
                        first_voice(&parsed.document),
                        error.to_string(),
                    )
                    .hint("bake the story again: raconteur bake"),
                );
                None
            }
        });
        progress(LoadStage::Story);
        let sources = TimingSources {
            bundle,
            library: &Library::default(),
        };
        let mut script = Self::resolve(parsed, sources, bundle_json.is_some());
        script.yield_to();
        let told = script.report_progress();
        script.diagnostics.extend(told);
        script
    }

    /// Assigns a time to every clause of a text. `voice_was_given` is also true for an unreadable
    /// bundle.
    pub(crate) fn resolve(
        parsed: Parsed,
        TimingSources { bundle, library }: TimingSources<'_>,
        voice_was_given: bool,
    ) -> Self {
        let Parsed {
            document,
            mut diagnostics,
        } = parsed;
        let voices = Voices::find(&document, bundle.as_deref());
        let durations = KnownDurations {
            bundle: bundle.as_deref(),
            voices: &voices,
            library,
        };
        let resolved = Timeline::resolve(&document, &durations);
        diagnostics.extend(resolved.diagnostics);
        diagnostics.extend(missing_speech(
            &document,
            bundle.as_deref(),
            &voices,
            voice_was_given,
        ));
        let diagnostics = thinned(diagnostics);
        Self {
            document,
            timeline: resolved.timeline,
            diagnostics,
            bundle,
            hands_from_secs: f64::NEG_INFINITY,
            waits_secs: 0.0,
            voices,
            page_language: None,
            repertoire: Repertoire::new(Options::default().seed),
        }
    }

    /// Recomputes the time of every clause with the lengths of these animations.
    pub fn retime(&mut self, library: &Library) {
        let durations = KnownDurations {
            bundle: self.bundle.as_deref(),
            voices: &self.voices,
            library,
        };
        self.timeline = Timeline::resolve(&self.document, &durations).timeline;
        self.yield_to();
    }

    /// Delays the script for the preparation of its first gesture, or the gesture itself, or
    /// neither, as the script specifies.
    fn yield_to(&mut self) {
        match self.document.run_up.unwrap_or_default() {
            RunUp::Delay => {
                self.waits_secs = self.run_up_secs();
                self.delay(self.waits_secs);
            }
            RunUp::Late => self.hands_from_secs = RUN_UP_SECS,
            RunUp::Snap => {}
        }
    }

    /// Returns the gestures whose strokes are delayed because the hands must reach their start:
    /// their clauses, and the delays, seconds.
    #[must_use]
    pub fn late_strokes(&self) -> Vec<(ClauseId, f64)> {
        let clauses = self.timeline.clauses.iter();
        clauses
            .filter(|c| is_gesture(&self.document, c.clause))
            .map(|c| (c.clause, self.hands_from_secs - c.start_secs))
            .filter(|(_, late_secs)| *late_secs > UNSEEN_SECS)
            .collect()
    }

    /// Returns diagnostics for hands that arrive at other times than scripted.
    pub(crate) fn report_progress(&self) -> Vec<Diagnostic> {
        let tag = |id: ClauseId| self.document.clause(id).tag_span;
        let mut told: Vec<_> = self
            .late_strokes()
            .into_iter()
            .map(|(id, late_secs)| {
                let message = format!(
                    "this stroke is {late_secs:.2} s late, because the hand needs time to arrive"
                );
                Diagnostic::warning("player::late", tag(id), message)
                    .hint("give it more time before, or r:lead='snap' of eml, or 'delay'")
            })
            .collect();
        let mut clauses = self.timeline.clauses.iter();
        let first = clauses.find(|c| is_gesture(&self.document, c.clause));
        // An author who sets the run-up expects the delay.
        let is_asked = self.document.run_up.is_some();
        if let Some(first) = first.filter(|_| self.waits_secs > UNSEEN_SECS && !is_asked) {
            let message = format!(
                "the whole script begins {:.2} s later than it is written, for the hand to get here first",
                self.waits_secs
            );
            told.push(
                Diagnostic::warning("player::delayed", tag(first.clause), message).hint(
                    "write r:lead='late' or 'snap' in eml to keep the written times, 'delay' to accept the delay, or start the gesture later",
                ),
            );
        }
        told
    }

    /// Returns the delay of a script whose first gesture would begin before the arm can reach it,
    /// seconds, so the storyteller raises a hand instead of starting with it raised.
    fn run_up_secs(&self) -> f64 {
        let mut clauses = self.timeline.clauses.iter();
        let first = clauses.find(|c| is_gesture(&self.document, c.clause));
        first.map_or(0.0, |c| (RUN_UP_SECS - c.start_secs).max(0.0))
    }

    /// Shifts the whole script to a later time; everything lowered from it follows.
    pub(crate) fn delay(&mut self, delay_secs: f64) {
        let timeline = &mut self.timeline;
        for clause in &mut timeline.clauses {
            clause.start_secs += delay_secs;
            clause.end_secs += delay_secs;
        }
        timeline.marks.values_mut().for_each(|at| *at += delay_secs);
        timeline.lead_in_secs += delay_secs;
        timeline.duration_secs += delay_secs;
    }

    /// Returns the names of the animations that the story plays, each once; [`Script::retime`] and
    /// the player need their texts.
    #[must_use]
    pub fn needed_animations(&self) -> Vec<String> {
        let needs = Requirements::from_document(&self.document);
        needs.animations().map(str::to_owned).collect()
    }

    /// Returns the baked utterance (synthesised ahead of time) of a clause; `None` if there is
    /// none.
    pub(crate) fn utterance(&self, clause: ClauseId) -> Option<&Arc<Utterance>> {
        self.voices.match_clauses(clause, self.bundle.as_deref())
    }

    /// Returns the phone set of a clause's speech; Festival's if it was not baked.
    pub(crate) fn phone_set(&self, clause: ClauseId) -> &str {
        self.voice(clause).map_or("radio", |voice| &voice.phone_set)
    }

    /// Returns the language of a clause's speech, if it was baked.
    pub(crate) fn language(&self, clause: ClauseId) -> Option<&str> {
        self.voice(clause).map(|voice| &*voice.language)
    }

    /// Returns the default language: the performer's, else that of the bundle's first voice, else
    /// that of the surrounding page.
    pub(crate) fn usual_language(&self) -> Option<&str> {
        let performer = self.document.performer.as_ref();
        let voices = self.bundle.iter().flat_map(|bundle| &bundle.voices);
        let mut baked = voices.map(|voice| &*voice.language);
        performer
            .and_then(|performer| performer.language.as_deref())
            .or_else(|| baked.next())
            .or(self.page_language.as_ref().map(LanguageTag::as_str))
    }

    /// Returns the voice that the script names for a clause; `None` if it names none.
    pub(crate) fn named_voice(&self, clause: ClauseId) -> Option<&str> {
        self.voices.named(clause)
    }

    /// Returns the voice of a clause, if it was baked.
    pub(crate) fn voice(&self, clause: ClauseId) -> Option<&Voice> {
        let voice = self.utterance(clause)?.voice;
        self.bundle.as_ref()?.voices.get(voice)
    }
}

/// Returns the performer chosen by a text, with voice and language; empty if it chooses none.
#[must_use]
pub fn performer_of(eml: &str) -> Performer {
    parse(eml).document.performer.unwrap_or_default()
}

/// Time that an arm needs from rest to any first stroke, seconds. Longest preparation of the
/// gesture planner, rounded up.
const RUN_UP_SECS: f64 = 0.9;

/// Delay and lateness that are not visible, seconds.
const UNSEEN_SECS: f64 = 0.01;

fn is_gesture(document: &Document, id: ClauseId) -> bool {
    matches!(document.clause(id).kind, ClauseKind::GestureKey(_))
}

/// Returns every clause that speaks, with its tag.
fn speaking(document: &Document) -> impl Iterator<Item = (ClauseId, Span)> {
    document.iter().filter_map(|(id, c)| match &c.kind {
        ClauseKind::VoiceText(v) => v.has_words().then_some((id, c.tag_span)),
        ClauseKind::VoiceSay(say) => say.is_heard().then_some((id, c.tag_span)),
        _ => None,
    })
}

fn first_voice(document: &Document) -> Span {
    speaking(document)
        .next()
        .map_or(Span::new(0, 0), |(_, span)| span)
}

/// Returns one warning if nothing was baked, else one for each missing utterance.
fn missing_speech(
    document: &Document,
    bundle: Option<&Bundle>,
    voices: &Voices,
    bundle_was_given: bool,
) -> Vec<Diagnostic> {
    if !bundle_was_given {
        return speaking(document)
            .next()
            .map(|(_, span)| {
                Diagnostic::warning(
                    "player::no-bundle",
                    span,
                    "this story has no speech bundle; it plays with captions and estimated times, silently if no other voice is available",
                )
                .hint("make one with: raconteur bake")
            })
            .into_iter()
            .collect();
    }
    if bundle.is_none() {
        return Vec::new();
    }
    speaking(document)
        .filter(|(id, _)| voices.match_clauses(*id, bundle).is_none())
        .map(|(id, span)| match &document.clause(id).kind {
            ClauseKind::VoiceSay(say) if say.is_file() => Diagnostic::warning(
                "player::not-baked",
                span,
                format!(
                    "the speech bundle does not contain the speech of {}; the story continues without it",
                    say.content
                ),
            )
            .hint("put the file where the story looks for it, then: raconteur bake"),
            _ => Diagnostic::warning(
                "player::not-baked",
                span,
                "the speech bundle does not contain this text; it plays with captions, silently if no other voice is available",
            )
            .hint("bake the story again: raconteur bake"),
        })
        .collect()
}
