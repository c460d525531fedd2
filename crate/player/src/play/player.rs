//! Player: evaluates any time of a story for one figure.

use std::sync::Arc;

use raconteur_actor::{Actor, FaceRig, LipTrack};
use raconteur_base::{DVec3, Side};
use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};
use raconteur_body::{Figure, Pose};
use raconteur_eml::{Diagnostic, Performer, Timeline, thinned};
use raconteur_speech::bundle::Bundle;
use raconteur_stage::{EmotionTimeline, Frame, Lighting, StageSet, View};

use crate::lower::cast::Cast;
use crate::lower::cues::{Cue, UtteranceCue};
use crate::lower::flow::WayCue;
use crate::lower::music::MusicCue;
use crate::lower::plan::{CarriedCommands, ScriptPlan};
use crate::lower::questions::QuestionCue;
use crate::lower::repertoire::Repertoire;
use crate::lower::script::{LoadStage, Script};
use crate::lower::units::Units;
use crate::lower::{animations, palms, reach};
use crate::options::Options;
use crate::play::actor_builder::{ActorBuilder, FramingNeeds};
use crate::play::clock::Clock;
use crate::play::crossfade::{ActorCrossfade, EvaluatedPose};
use crate::play::event::Event;
use crate::play::script_set::ScriptSet;
use crate::play::shot_director::ShotDirector;
use crate::play::soft::SoftFace;
use crate::play::swinging_parts::SwingingParts;

mod clips;
mod frames;
mod idle;
mod improvise;
pub(crate) mod readings;

use clips::Animations;
use idle::IdleBehaviour;

/// Input of a [`Player`]: script, speech bundle, figure and options.
pub struct StoryInput<'a> {
    /// Text of the script.
    pub eml: &'a str,
    /// The JSON of its speech bundle, if it has one.
    pub bundle: Option<&'a [u8]>,
    /// The figure that performs.
    pub figure: Arc<Figure>,
    /// Options of the performance.
    pub options: Options,
}

/// Loaded player, with the diagnostics of its story.
pub struct LoadedPlayer {
    /// Ready to evaluate frames.
    pub player: Player,
    /// Problems of the script; the rest plays.
    pub diagnostics: Vec<Diagnostic>,
}

/// Target of a hand at one time, and the distance by which the hand misses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manipulator {
    /// Name of the manipulator, `leftArm` or `rightArm`.
    pub name: &'static str,
    /// Target of the wrist, world, metres.
    pub target_in_world: DVec3,
    /// Distance of the wrist from there, metres.
    pub error_m: f64,
}

/// Player of one story with one figure: evaluates any story time, including live additions. Frames
/// depend only on the time, so seeking costs no more than playing.
///
/// # Examples
///
/// ```
/// use raconteur_player::body::read::read_figure;
/// use raconteur_player::{Options, Player, StoryInput};
/// use std::sync::Arc;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// let figure = read_figure("nuno", &std::fs::read("../../assets/figures/nuno.glb")?)?;
/// let mut player = Player::load(StoryInput {
///     eml: "<eml><body><voice-text time='0'>Hello!</voice-text></body></eml>",
///     bundle: None,
///     figure: Arc::new(figure),
///     options: Options::default(),
/// })
/// .player;
/// let frame = player.frame(0.5, 16.0 / 9.0);
/// assert!(frame.camera.eye_in_world.z > 0.0, "the camera stands before the figure");
/// # Ok(())
/// # }
/// ```
pub struct Player {
    cast: Cast,
    options: Options,
    script: Script,
    animations: Animations,
    scripts: ScriptSet,
    clock: Clock,
    /// All emotions.
    emotions: EmotionTimeline,
    /// Lamps chosen by the page; `None`: those of the story's set.
    lighting: Option<Lighting>,
    /// Set chosen by the page; `None`: the story's.
    set_override: Option<StageSet>,
    shots: ShotDirector,
    actors: ActorCrossfade,
    /// The tissue of the face, if the figure has any.
    soft: Option<SoftFace>,
    /// Swinging hair of the figure; `None` if it has none.
    swinging: Option<SwingingParts>,
    /// Room to evaluate other times in.
    scratch: EvaluatedPose,
    /// The waiting figure, until the story has taken over.
    idle: Option<Box<IdleBehaviour>>,
    pose: Pose,
    frame: Frame,
}

impl Player {
    /// Reads a story and prepares its performance. Never fails; see [`LoadedPlayer::diagnostics`].
    #[must_use]
    pub fn load(input: StoryInput<'_>) -> LoadedPlayer {
        Self::load_with_progress(input, &mut |_| ())
    }

    /// Loads a story like [`Player::load`] and calls `progress` as each stage begins.
    #[must_use]
    pub fn load_with_progress(
        input: StoryInput<'_>,
        progress: &mut dyn FnMut(LoadStage),
    ) -> LoadedPlayer {
        let mut script = Script::read_with_progress(input.eml, input.bundle, progress);
        progress(LoadStage::Performance);
        let options = input.options;
        script.page_language = options.language;
        script.repertoire = Repertoire::choose(&script.document, options.seed);
        let cast = Cast::new(input.figure, &script.document, options.handedness);
        let story = ScriptPlan::new(&script, &cast, 0, None);
        let animations = Animations::default();
        let (actor, needs) = ActorBuilder {
            cast: &cast,
            options: &options,
            library: &animations.library,
            carried: &CarriedCommands::default(),
            min_margin: options.margin,
        }
        .actor([&story].into_iter());
        let diagnostics = diagnostics(&script, &cast, &actor);
        let morphs = cast.morphs();
        let tissue = cast.figure.tissue.as_ref();
        let mut frame = Frame::with_capacity(cast.figure.skeleton.joints().len(), morphs);
        frame.tissue = vec![NodeState::default(); tissue.map_or(0, |t| t.rest.len())];
        let end_secs = script.timeline.duration_secs;
        let score = ScriptSet::new(story);
        let feelings = score.feelings(&animations.library, end_secs);
        let player = Self {
            options,
            script,
            animations,
            shots: ShotDirector::new(&options, &score.story, &feelings),
            emotions: feelings,
            lighting: None,
            set_override: None,
            scripts: score,
            clock: Clock::new(),
            actors: ActorCrossfade::new(actor, needs, morphs),
            soft: tissue.map(SoftFace::new),
            swinging: SwingingParts::new(&cast.figure.springs, cast.figure.skeleton.joints().len()),
            scratch: EvaluatedPose::new(morphs),
            idle: None,
            pose: Pose::zero(),
            frame,
            cast,
        };
        LoadedPlayer {
            player,
            diagnostics,
        }
    }

    /// Returns the duration of the script, seconds; live clauses may continue beyond it.
    #[must_use]
    pub fn duration_secs(&self) -> f64 {
        self.script.timeline.duration_secs
    }

    /// Returns the end of everything known: the script, live clauses, and the time that an
    /// open-ended performance has reached; seconds.
    #[must_use]
    pub fn end_secs(&self) -> f64 {
        self.duration_secs()
            .max(self.scripts.live.end_secs())
            .max(self.clock.open_until_secs())
    }

    /// Sets whether the clock may pass the end, because more may arrive: while a mind is connected.
    pub fn set_open_ended(&mut self, open_ended: bool) {
        self.clock.set_open_ended(open_ended);
    }

    /// Returns the performing figure.
    #[must_use]
    pub fn figure(&self) -> &Arc<Figure> {
        &self.cast.figure
    }

    /// Replaces the figure's face: `figure` is the performing figure changed by
    /// [`Reshaper::with_face`](raconteur_reshape::Reshaper::with_face), with the same bones.
    /// Playback continues.
    pub fn set_face(&mut self, figure: Arc<Figure>) {
        self.cast.face = FaceRig::new(&figure);
        self.soft = figure.tissue.as_ref().map(SoftFace::new);
        self.cast.figure = figure;
        // The idle figure is created again from the figure.
        self.idle = None;
    }

    /// Replaces the face like [`Player::set_face`], for an intermediate face that differs little
    /// from the previous one: its soft tissue keeps the motion of the previous one, which takes no
    /// time.
    pub fn move_face(&mut self, figure: Arc<Figure>) {
        let soft = self.soft.take();
        let nodes = |figure: &Figure| figure.tissue.as_ref().map(|tissue| tissue.rest.len());
        if soft.is_none() || nodes(&figure) != nodes(&self.cast.figure) {
            self.set_face(figure);
            return;
        }
        self.cast.face = FaceRig::new(&figure);
        self.cast.figure = figure;
        self.idle = None;
        self.soft = soft;
    }

    /// Returns the mapping of EML's coordinates for this figure.
    #[must_use]
    pub fn units(&self) -> &Units {
        &self.cast.units
    }

    /// Returns the last evaluated frame; empty before the first.
    #[must_use]
    pub fn last_frame(&self) -> &Frame {
        &self.frame
    }

    /// Returns the performer chosen by the script, with voice and language; the actual figure is
    /// [`Player::figure`].
    #[must_use]
    pub fn choice(&self) -> Option<&Performer> {
        self.script.document.performer.as_ref()
    }

    /// Returns the questions of the script, sorted by time.
    #[must_use]
    pub fn questions(&self) -> Vec<QuestionCue> {
        self.script.questions()
    }

    /// Returns the entries on all paths through the script, in the order of traversal.
    #[must_use]
    pub fn flow(&self) -> Vec<WayCue> {
        self.script.flow_entries()
    }

    /// Returns the timeline of the script: the resolved times of all clauses.
    #[must_use]
    pub fn timeline(&self) -> &Timeline {
        &self.script.timeline
    }

    /// Returns the script's utterances, sorted by time.
    #[must_use]
    pub fn utterances(&self) -> &[UtteranceCue] {
        &self.scripts.story.utterances
    }

    /// Returns an utterance by the index in cues: of the script, or of the stored part of the live
    /// performance.
    #[must_use]
    pub fn utterance(&self, index: usize) -> Option<&UtteranceCue> {
        self.scripts.utterance(index)
    }

    /// Returns the cues of the script, sorted by time.
    #[must_use]
    pub fn cues(&self) -> &[Cue] {
        &self.scripts.story.cues
    }

    /// Returns the music of the story and of live additions, by time.
    #[must_use]
    pub fn music(&self) -> Vec<MusicCue> {
        self.scripts.music(&self.emotions, self.end_secs())
    }

    /// Takes the speech of coming fragments: a bundle that begins with the known utterances.
    /// Returns false, and changes nothing, if it does not.
    pub fn update_bundle(&mut self, bundle_json: &[u8]) -> bool {
        let Ok(bundle) = Bundle::from_json(bundle_json) else {
            return false;
        };
        let known = self.script.bundle.iter().flat_map(|b| &b.utterances);
        let begins = known
            .zip(
                bundle
                    .utterances
                    .iter()
                    .map(Some)
                    .chain(core::iter::repeat(None)),
            )
            .all(|(known, given)| given.is_some_and(|given| given.key == known.key));
        if begins {
            self.script.bundle = Some(Arc::new(bundle));
        }
        begins
    }

    /// Prepares an actor for all that is known, with no less room than the last one has.
    fn rehearse(&self) -> (Actor, FramingNeeds) {
        ActorBuilder {
            cast: &self.cast,
            options: &self.options,
            library: &self.animations.library,
            carried: self.scripts.live.carried(),
            min_margin: self.actors.last_margin(),
        }
        .actor(self.scripts.plans())
    }

    /// Returns the tissue of the face and its network as of the last frame; `None` if the figure
    /// has none.
    pub(crate) fn face(&self) -> Option<(&Tissue, &Network)> {
        Some((
            self.cast.figure.tissue.as_ref()?,
            self.soft.as_ref()?.network(),
        ))
    }

    /// Controls of the face at a story time: contractions of its muscles, jaw, lids,
    /// tongue.
    #[must_use]
    pub fn face_controls(&self, time_secs: f64) -> FaceControls {
        self.actors.controls(time_secs)
    }

    /// Returns the lip tracks of all utterances with their starts, story time, seconds.
    #[must_use]
    pub fn lips(&self) -> &[(f64, LipTrack)] {
        self.actors.actor().lips()
    }

    /// Returns the upper lid angles of the last frame and those of closed lids, left and right,
    /// radians.
    pub(crate) fn lids_rad(&self) -> ([f64; 2], [f64; 2]) {
        (self.pose.upper_lid_rad, self.cast.figure.lid_closure_rad)
    }

    /// Resets the simulation of tissue and hair, because their drivers have changed.
    fn forget_motion(&mut self) {
        if let Some(soft) = &mut self.soft {
            soft.forget();
        }
        if let Some(sway) = &mut self.swinging {
            sway.forget();
        }
    }

    /// Advances the time: the cues up to `time_secs` become available to [`Player::drain_events`].
    /// A time in the past has no effect; see [`Player::seek`].
    pub fn advance(&mut self, time_secs: f64) {
        self.clock.advance(time_secs);
    }

    /// Seeks without delivering the cues between; those at `time_secs` itself are still to come.
    /// Live clauses keep their times; those skipped by a forward seek are reported as skipped.
    pub fn seek(&mut self, time_secs: f64) {
        let (from_secs, to_secs) = self.clock.seek(time_secs);
        self.scripts.live.skip(from_secs, to_secs);
        self.forget_welcome();
    }

    /// Returns the events since the last call, by time.
    pub fn drain_events(&mut self) -> Vec<Event> {
        let cues = self.scripts.take_cues(self.clock.deliver());
        let utterance = |index| self.utterance(index);
        cues.iter()
            .filter_map(|c| Event::new(c, utterance))
            .collect()
    }

    /// Shows the whole figure from another direction, whatever the shot; `None` returns to the
    /// shot. The figure still speaks to the camera of the shot.
    pub fn set_view(&mut self, view: Option<View>) {
        self.shots.set_view(view);
    }

    /// Sets the light of the stage without emotion; `None` uses the lamps of the story's set.
    pub fn set_lighting(&mut self, lighting: Option<Lighting>) {
        self.lighting = lighting;
    }

    /// Overrides the stage set, for example fireside or garden; `None` uses the story's.
    pub fn override_set(&mut self, set: Option<StageSet>) {
        self.set_override = set;
    }

    /// Keeps hands and feet above captions that take this share of the image height at its lower
    /// edge, 0 to [`raconteur_stage::MAX_CAPTIONS`].
    pub fn set_captions(&mut self, share: f64) {
        self.shots.set_captions(share);
    }
}

/// Problems of a script when this figure performs it.
fn diagnostics(script: &Script, cast: &Cast, actor: &Actor) -> Vec<Diagnostic> {
    let (document, timeline) = (&script.document, &script.timeline);
    let mut diagnostics = script.diagnostics.clone();
    diagnostics.extend(cast.problems(document));
    diagnostics.extend(animations::problems(document, timeline, None));
    let plans = Side::BOTH.map(|side| actor.plan(side));
    diagnostics.extend(reach::late(document, timeline, plans));
    diagnostics.extend(palms::missed(document, timeline, plans, cast.hands));
    thinned(diagnostics)
}
