//! The player: evaluates any moment of a story for one figure.

use std::sync::Arc;

use raconteur_actor::Report;
use raconteur_actor::gesture::TrunkShape;
use raconteur_actor::{Actor, FaceRig, Library, LipTrack, Sex};
use raconteur_base::order::sort_by_number;
use raconteur_base::{DVec3, Side};
use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};
use raconteur_body::{Bone, Figure, Pose};
use raconteur_eml::{Diagnostic, Performer, Timeline, thinned};
use raconteur_stage::{Camera, Frame, Room, Shot, View};

use crate::live::{self, Live, Performed, Scene};
use crate::lower::cues::{Cue, UtteranceCue};
use crate::lower::geometry::Geometry;
use crate::lower::gestures::{self, Hands, Reach};
use crate::lower::music::{self, MusicClause, MusicCue};
use crate::lower::part::{self, Carried, Part};
use crate::lower::script::{Reading, Script};
use crate::lower::units::Units;
use crate::lower::views::Views;
use crate::lower::{animations, manipulators, parameters};
use crate::options::Options;
use crate::play::event::Event;
use crate::play::fibres;
use crate::play::layers::Layers;
use crate::play::soft::SoftFace;

mod clips;
mod readings;
mod welcome;

use welcome::Welcome;

/// What a player needs.
pub struct StoryInput<'a> {
    /// The script's text.
    pub eml: &'a str,
    /// The JSON of its speech bundle, if it has one.
    pub bundle: Option<&'a [u8]>,
    /// Who performs.
    pub figure: Arc<Figure>,
    /// How.
    pub options: Options,
}

/// A player, and what was wrong with its story.
pub struct Loaded {
    /// Ready to be asked for frames.
    pub player: Player,
    /// Problems of the script; the rest plays.
    pub diagnostics: Vec<Diagnostic>,
}

/// Where a hand was sent and how near it came.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Manipulator {
    /// `leftArm` or `rightArm`.
    pub name: &'static str,
    /// Where the wrist was to be, world, metres.
    pub target_in_world: DVec3,
    /// Distance of the wrist from there, metres.
    pub error_m: f64,
}

/// Evaluates any moment of a story, and of what joins it while it plays. Frames depend on the
/// time alone, so seeking costs no more than playing.
pub struct Player {
    figure: Arc<Figure>,
    face: FaceRig,
    units: Units,
    reach: Reach,
    trunk: TrunkShape,
    options: Options,
    hands: Hands,
    script: Script,
    library: Library,
    /// Animations that could not be had, or not read.
    missing_animations: Vec<String>,
    story: Part,
    live: Live,
    layers: Layers,
    /// Where the figure's face has tissue.
    soft: Option<SoftFace>,
    /// How the figure waits, while it does and until it has left off.
    welcome: Option<Box<Welcome>>,
    geometry: Geometry,
    view: Option<View>,
    views: Views,
    /// Cues up to this time are passed.
    passed_secs: f64,
    /// Cues up to this time are told.
    delivered_until_secs: f64,
    /// The clock may pass the end.
    open_ended: bool,
    /// The latest time that the clock has come to beyond the end.
    open_until_secs: f64,
    pose: Pose,
    frame: Frame,
}

/// Length of a hand with a margin, share of stature (0.108 in adults, ANSUR).
const HAND_LENGTH: f64 = 0.12;

impl Player {
    /// Reads a story and prepares its performance. Never fails; see [`Loaded::diagnostics`].
    #[must_use]
    pub fn load(input: StoryInput<'_>) -> Loaded {
        Self::load_telling(input, &mut |_| ())
    }

    /// [`Player::load`]; `told` hears of each part of the story as its reading begins.
    #[must_use]
    pub fn load_telling(input: StoryInput<'_>, told: &mut dyn FnMut(Reading)) -> Loaded {
        let script = Script::read_telling(input.eml, input.bundle, told);
        told(Reading::Performance);
        let figure = input.figure;
        let units = Units::of(&figure.skeleton);

        let shown = input.options.handedness;
        let hands = Hands::of(&script.document, shown, figure.dominant_hand);
        let options = Options {
            handedness: Some(hands.dominant),
            ..input.options
        };
        let reach = Reach::of(&figure.skeleton);
        let mut diagnostics = script.diagnostics.clone();
        diagnostics.extend(gestures::out_of_reach(
            &script.document,
            &units,
            &reach,
            hands,
        ));
        let (document, timeline) = (&script.document, &script.timeline);
        diagnostics.extend(parameters::problems(document));
        diagnostics.extend(manipulators::problems(document, &units, &reach));
        diagnostics.extend(animations::problems(
            document,
            timeline,
            &figure.skeleton,
            None,
        ));

        let story = Part::new(&script, &units, hands, 0, None);
        let live = Live::new(story.utterances.len());
        let trunk = TrunkShape::of(&figure);
        let library = Library::default();
        let (actor, room) = rehearse(
            &figure,
            &options,
            trunk,
            input.options.room,
            &library,
            &Carried::default(),
            [&story].into_iter(),
        );
        let plans = Side::BOTH.map(|side| actor.plan(side));
        diagnostics.extend(gestures::late(&script.document, &script.timeline, plans));
        let diagnostics = thinned(diagnostics);
        let mut geometry = Geometry::default();
        geometry.retell(&story.geometry);
        let morphs = figure.morph_names.len();
        let player = Self {
            views: Views::new(input.options.shot, story.shots.iter()),
            face: FaceRig::new(&figure),
            units,
            reach,
            trunk,
            options,
            hands,
            script,
            library,
            missing_animations: Vec::new(),
            story,
            live,
            layers: Layers::new(actor, room, morphs),
            soft: figure.tissue.as_ref().map(SoftFace::new),
            welcome: None,
            geometry,
            view: None,
            passed_secs: -1.0,
            delivered_until_secs: -1.0,
            open_ended: false,
            open_until_secs: 0.0,
            pose: Pose::zero(),
            frame: {
                let mut frame = Frame::with_capacity(figure.skeleton.joints().len(), morphs);
                let nodes = figure.tissue.as_ref().map_or(0, |t| t.rest.len());
                frame.tissue = vec![NodeState::default(); nodes];
                frame
            },
            figure,
        };
        Loaded {
            player,
            diagnostics,
        }
    }

    /// Length of the script, seconds; live clauses may go on beyond it.
    #[must_use]
    pub fn duration_secs(&self) -> f64 {
        self.script.timeline.duration_secs
    }

    /// When everything that is known is over: the script, live clauses, and the time that an
    /// open-ended performance has come to; seconds.
    #[must_use]
    pub fn end_secs(&self) -> f64 {
        self.duration_secs()
            .max(self.live.end_secs())
            .max(self.open_until_secs)
    }

    /// Whether the clock may pass the end, because more may come: while a mind listens.
    pub fn set_open_ended(&mut self, open_ended: bool) {
        self.open_ended = open_ended;
    }

    /// Who performs.
    #[must_use]
    pub fn figure(&self) -> &Arc<Figure> {
        &self.figure
    }

    /// Where EML's coordinates lie for this figure.
    #[must_use]
    pub fn units(&self) -> &Units {
        &self.units
    }

    /// The frame that was asked for last; empty before the first.
    #[must_use]
    pub fn last_frame(&self) -> &Frame {
        &self.frame
    }

    /// Whom the script chooses to perform it, in what voice and language; who does is
    /// [`Player::figure`].
    #[must_use]
    pub fn choice(&self) -> Option<&Performer> {
        self.script.document.performer.as_ref()
    }

    /// When everything in the script happens.
    #[must_use]
    pub fn timeline(&self) -> &Timeline {
        &self.script.timeline
    }

    /// What the script says, in order of time.
    #[must_use]
    pub fn utterances(&self) -> &[UtteranceCue] {
        &self.story.utterances
    }

    /// An utterance by the index that cues give: of the script, or of what is remembered of
    /// the live performance.
    #[must_use]
    pub fn utterance(&self, index: usize) -> Option<&UtteranceCue> {
        let live = || self.live.utterances().find(|(i, _)| *i == index);
        self.story
            .utterances
            .get(index)
            .or_else(|| live().map(|(_, u)| u))
    }

    /// What listeners are told of the script, in order of time.
    #[must_use]
    pub fn cues(&self) -> &[Cue] {
        &self.story.cues
    }

    /// The music under the story and under what joined it, by time.
    #[must_use]
    pub fn music(&self) -> Vec<MusicCue> {
        let parts = self.parts();
        let mut clauses: Vec<MusicClause> = parts
            .clone()
            .flat_map(|p| p.music.iter().cloned())
            .collect();
        sort_by_number(&mut clauses, |c| c.start_secs);
        music::cues(&clauses, parts.flat_map(|p| &p.utterances))
    }

    /// Performs EML that comes while the story plays (GEVH 3.6): a list of clauses or a whole
    /// script. Plain times count from `now_secs` (story time), names are those of the
    /// fragment, of earlier ones and of the script. `mind` tells senders apart, each of which
    /// has an allowance; see [`live::limits`].
    ///
    /// The same fragments at the same times give the same frames, however often frames are
    /// asked for between.
    pub fn perform(&mut self, mind: u32, fragment: &str, now_secs: f64) -> Performed {
        let now_secs = if now_secs.is_finite() {
            now_secs.max(0.0)
        } else {
            0.0
        };
        // What comes within one change of actors shares it, what comes soon after waits for
        // the next; after a seek to earlier times the change begins there.
        let last_secs = self.layers.last_change_secs();
        let base_secs = if last_secs - now_secs > Layers::APART_SECS {
            now_secs
        } else if last_secs >= now_secs {
            last_secs
        } else {
            now_secs.max(last_secs + Layers::APART_SECS)
        };
        let scene = Scene {
            units: &self.units,
            reach: &self.reach,
            hands: self.hands,
            bundle: self.script.bundle.as_ref(),
            library: &self.library,
            marks: &self.script.timeline.marks,
            sets: &self.script.document.sets,
            actor: self.layers.actor(),
            skeleton: &self.figure.skeleton,
            story_players: &self.story.players,
        };
        let performed = self.live.admit(mind, fragment, now_secs, base_secs, &scene);
        if !performed.clauses.is_empty() {
            let parts = self.parts();
            let shots = parts.flat_map(|p| &p.shots);
            self.views = Views::new(self.options.shot, shots);
            let (actor, room) = self.rehearse_all(self.layers.last_room());
            self.layers.change(base_secs, actor, room);
            self.forget_face();
            if let Some(fragment) = self.live.parts().last() {
                self.geometry.join(&fragment.geometry);
            }
        }
        performed
    }

    /// The story, and what joined it, in the order in which it came.
    fn parts(&self) -> impl Iterator<Item = &Part> + Clone {
        [&self.story].into_iter().chain(self.live.parts())
    }

    /// Prepares an actor for all that is known.
    fn rehearse_all(&self, held: Room) -> (Actor, Room) {
        let parts = self.parts();
        let carried = self.live.carried();
        rehearse(
            &self.figure,
            &self.options,
            self.trunk,
            held,
            &self.library,
            carried,
            parts,
        )
    }

    /// The tissue of the face and its network as they were for the last frame; none where the
    /// figure has none.
    pub(crate) fn face(&self) -> Option<(&Tissue, &Network)> {
        Some((self.figure.tissue.as_ref()?, self.soft.as_ref()?.network()))
    }

    /// What the face is asked to do at a story time: contractions of its muscles, jaw, lids,
    /// tongue.
    #[must_use]
    pub fn face_controls(&self, time_secs: f64) -> FaceControls {
        self.layers.controls(time_secs)
    }

    /// Everything that is said: when it begins, story seconds, and its lips.
    #[must_use]
    pub fn lips(&self) -> &[(f64, LipTrack)] {
        self.layers.actor().lips()
    }

    /// Upper lids of the last frame, radians: where they are and where they are closed.
    pub(crate) fn lids_rad(&self) -> ([f64; 2], [f64; 2]) {
        (self.pose.upper_lid_rad, self.figure.lid_closure_rad)
    }

    /// The face is asked for something else from now on.
    fn forget_face(&mut self) {
        if let Some(soft) = &mut self.soft {
            soft.forget();
        }
    }

    /// Whether a mind may send a fragment at a story time without being refused for its pace.
    #[must_use]
    pub fn has_room(&self, mind: u32, now_secs: f64) -> bool {
        self.live.has_room(mind, now_secs)
    }

    /// Lets time pass: the cues up to `time_secs` are there for [`Player::drain_events`].
    /// Time that runs backwards passes nothing; see [`Player::seek`].
    pub fn advance(&mut self, time_secs: f64) {
        if time_secs > self.passed_secs {
            self.passed_secs = time_secs;
        }
        if self.open_ended && time_secs.is_finite() {
            self.open_until_secs = self.open_until_secs.max(time_secs);
        }
    }

    /// Moves without passing the cues between; those at `time_secs` itself are still to come.
    /// Live clauses keep their times; those that a move forwards passes over are told as
    /// skipped.
    pub fn seek(&mut self, time_secs: f64) {
        let to_secs = if time_secs.is_finite() {
            time_secs.next_down()
        } else {
            -1.0
        };
        self.live.skip(self.delivered_until_secs, to_secs);
        self.forget_welcome();
        self.passed_secs = to_secs;
        self.delivered_until_secs = to_secs;
    }

    /// What has happened since the last call, by time.
    pub fn drain_events(&mut self) -> Vec<Event> {
        let mut cues = self
            .live
            .take_cues(self.delivered_until_secs, self.passed_secs);
        let story = live::between(
            &self.story.cues,
            self.delivered_until_secs,
            self.passed_secs,
        );
        if !cues.is_empty() {
            cues.extend_from_slice(story);
            sort_by_number(&mut cues, |c| c.time_secs);
        }
        self.delivered_until_secs = self.passed_secs;
        let all = if cues.is_empty() { story } else { &cues };
        let utterance = |index| self.utterance(index);
        all.iter()
            .filter_map(|c| Event::new(c, utterance))
            .collect()
    }

    /// The frame of a time, for a picture of `aspect` (width over height). Times outside
    /// the story show its first or last moment, unless it is open-ended; a time that is not a
    /// number, the first.
    pub fn frame(&mut self, time_secs: f64, aspect: f64) -> &Frame {
        self.leave_welcome(time_secs);
        self.evaluate(time_secs);
        self.frame.camera = self.camera(aspect);
        &self.frame
    }

    /// Shows the whole figure from another side, whatever the shot; the shot again by none.
    /// The figure still speaks to where the shot's camera stands.
    pub fn set_view(&mut self, view: Option<View>) {
        self.view = view;
    }

    fn camera(&self, aspect: f64) -> Camera {
        let stature_m = self.figure.skeleton.stature_m();
        let room = self.layers.room_at(self.frame.time_secs);
        // Where the script has moved the figure; how it sways there is none of the camera's
        // business.
        let moved = self.layers.actor().world_from_figure(self.frame.time_secs);
        let place = moved.map_or(DVec3::ZERO, |m| m.translation.with_y(0.0));
        let frame = |shot: Shot| shot.frame(place, stature_m, aspect, room);
        match self.view {
            Some(view) => view.of(&frame(Shot::Full)),
            None => self.views.camera(self.frame.time_secs, frame),
        }
    }

    /// The order of evaluation: time, body and face, joints, sound, what is drawn.
    fn evaluate(&mut self, time_secs: f64) -> Report {
        let t = if time_secs.is_nan() {
            0.0
        } else {
            let open = self.open_ended && time_secs.is_finite();
            let end_secs = if open { time_secs } else { self.end_secs() };
            time_secs.min(end_secs).max(0.0)
        };
        self.frame.time_secs = t;
        let report = self.layers.evaluate(
            &self.figure.skeleton,
            &self.face,
            t,
            &mut self.pose,
            &mut self.frame.morph_weights,
        );
        if let Some(welcome) = &mut self.welcome {
            let weights = &mut self.frame.morph_weights;
            welcome.blend(
                &self.figure.skeleton,
                &self.face,
                t,
                &mut self.pose,
                weights,
            );
        }
        self.figure
            .skeleton
            .solve(&self.pose, &mut self.frame.world_from_joint);
        if let (Some(tissue), Some(soft)) = (&self.figure.tissue, &mut self.soft) {
            let controls = |t: f64| {
                let controls = self.layers.controls(t);
                let welcome = self.welcome.as_ref();
                welcome.map_or(controls, |w| w.controls(t, &controls))
            };
            soft.at(tissue, t, &controls, &mut self.frame.tissue);
        }
        self.frame.speech = self.speech_at(t);
        self.frame.shown = self.geometry.at(t);
        self.draw_tissue();
        self.frame.handles.clear();
        self.frame.handles.extend(report.led.into_iter().flatten());
        report
    }

    /// Lines of the face's tissue, where they are shown.
    fn draw_tissue(&mut self) {
        self.frame.lines.clear();
        let shown = self.frame.shown;
        if !(shown.springs || shown.muscles || shown.skull) {
            return;
        }
        let skull = Bone::Skull.index();
        let ends = (
            self.frame.world_from_joint.get(skull),
            self.figure.inverse_bind.get(skull),
        );
        if let (Some(tissue), Some(soft), (Some(world), Some(bind))) =
            (&self.figure.tissue, &self.soft, ends)
        {
            fibres::draw(
                shown,
                (tissue, soft.network()),
                &self.frame.tissue,
                *world * *bind,
                &mut self.frame.lines,
            );
        }
    }
}

/// Prepares an actor for all parts together, and the room that they need in the picture:
/// no less than `held`, so that the picture does not breathe with every gesture.
fn rehearse<'a>(
    figure: &Figure,
    options: &Options,
    trunk: TrunkShape,
    held: Room,
    library: &Library,
    carried: &Carried,
    parts: impl Iterator<Item = &'a Part> + Clone,
) -> (Actor, Room) {
    let stature_m = figure.skeleton.stature_m();
    let hand_m = HAND_LENGTH * stature_m;
    let rooms = parts.clone().flat_map(|p| {
        let asked = part::is_asked(&p.manipulators);
        [
            Some(gestures::room(&p.strokes, hand_m)),
            asked.then(|| manipulators::room(&p.manipulators, hand_m)),
        ]
    });
    let room = rooms.flatten().fold(held, |a, b| Room {
        top_m: a.top_m.max(b.top_m),
        half_width_m: a.half_width_m.max(b.half_width_m),
    });
    let camera = options.shot.frame(DVec3::ZERO, stature_m, 16.0 / 9.0, room);
    let performance = part::performance(
        parts,
        carried,
        library,
        options,
        trunk,
        Sex::of(figure.sex),
        camera.eye_in_world,
    );
    (Actor::new(&performance, &figure.skeleton), room)
}
