//! Heading: where a figure stands and which side it faces.
//!
//! The storyteller changes place at paragraphs and at some sentences, and turns to the side of the
//! character who speaks (role shift); the narrator returns to the listener.

use raconteur_base::{DAffine3, DQuat, DVec3, noise, ops};

use super::footwork::{CHANGE_SECS, Footwork, Standing, StandingChange};
use super::{FootPose, SentenceSpan, Vigour};
use crate::discourse::RoleSpan;
use crate::idle::stream;
use crate::superposition::SuperposedTrack;

/// Turn of the trunk to the side of a character, radians: with the head 15 to 25° in all. Designed.
const ROLE_TURN_RAD: f64 = 0.17;
/// Share of a referent's direction that the trunk turns, and the largest turn, radians. Designed.
const REFERENT_SHARE: f64 = 0.25;
const REFERENT_TURN_RAD: f64 = 0.16;
/// Time in which the trunk turns to a side or back, and its lead before the first word, seconds.
/// Designed.
const TURN_SECS: f64 = 0.8;
const TURN_LEAD_SECS: f64 = 0.35;
/// Pause between two speakers within which the narrator does not return, seconds. Designed.
const DIALOGUE_SECS: f64 = 0.7;
/// Shortest time between two changes of place: at a paragraph and at any other sentence, seconds.
/// Designed; people make 2 to 9 steps or shifts a minute.
const APART_SECS: [f64; 2] = [9.5, 12.5];
/// Largest displacement of a place: sideways, to the front, metres for a stature of 1.7 m.
/// Designed; people's shifts are 8 to 10 cm.
const PLACE_M: [f64; 2] = [0.075, 0.06];
/// Largest heading of a place, radians. Designed.
const HEADING_RAD: f64 = 0.16;
/// Part of a character's side in the heading of a place, radians. Designed.
const ROLE_HEADING_RAD: f64 = 0.1;
/// Silence after which the figure returns to its first place, seconds. Designed.
const HOME_SECS: f64 = 4.0;
/// Degree of sorrow from which a figure does not step.
const STILL_SORROW: f64 = 0.3;

/// Planned place, heading and turns of a figure.
#[derive(Clone, Debug, Default)]
pub(crate) struct Heading {
    footwork: Footwork,
    /// Turns of the trunk on the feet with roles, and towards referents, radians.
    turns: [SuperposedTrack<1>; 2],
    /// Scale of lengths for the figure's stature.
    scale: f64,
    /// Width of the stance, 0 to 1.
    width: f64,
    /// Vertical axis of the turn of the trunk in the figure, metres.
    axis: DVec3,
}

impl Heading {
    /// Plans the heading for the sentences and roles of a performance. `steps` is false for a
    /// figure whose legs other commands move.
    pub(crate) fn new(
        sentences: &[SentenceSpan],
        vigour: &Vigour<'_>,
        frame: (f64, DVec3),
        (seed, steps): (u64, bool),
    ) -> Self {
        let (scale, axis) = frame;
        let roles = &vigour.discourse.roles;
        let changes = if steps && vigour.amount > 0.0 {
            changes(sentences, roles, vigour, seed)
        } else {
            Vec::new()
        };
        Self {
            footwork: Footwork::new(&changes),
            turns: [turns(roles, vigour), referent_turns(vigour)].map(SuperposedTrack::new),
            scale,
            width: if steps { 1.0 } else { 0.0 },
            axis,
        }
    }

    /// Returns the width of the stance, 0 (the feet of the zero pose) to 1.
    pub(crate) fn stance_width(&self) -> f64 {
        self.width
    }

    /// Returns the turn of the trunk to a side on the feet at a time, radians.
    pub(crate) fn turn_rad(&self, time_secs: f64) -> f64 {
        let turns = self.turns.iter();
        turns.map(|turn| turn.sample(time_secs)[0]).sum()
    }

    /// Returns the weight at a time, see [`Footwork::weight`].
    pub(crate) fn weight(&self, time_secs: f64, idle: f64) -> f64 {
        self.footwork.weight(time_secs, idle)
    }

    /// Returns the displacement of the body at a time, metres, and its turn on the floor, radians.
    pub(crate) fn body(&self, time_secs: f64) -> (DVec3, f64) {
        let at = self.footwork.body(time_secs);
        (DVec3::new(at.x, 0.0, at.z) * self.scale, at.yaw)
    }

    /// Returns the world-from-home transform of each foot's floor point at a time, with its lift,
    /// metres, and pitch, radians.
    pub(crate) fn feet(&self, time_secs: f64) -> [(DAffine3, f64, f64); 2] {
        self.footwork.feet(time_secs).map(|foot: FootPose| {
            let at = foot.standing;
            let place = DVec3::new(at.x, 0.0, at.z) * self.scale;
            (
                DAffine3::from_rotation_translation(DQuat::from_rotation_y(at.yaw), place),
                foot.lift_m * self.scale,
                foot.pitch_rad,
            )
        })
    }

    /// Returns the transform that carries gestures with the heading at a time: from the axes of
    /// the figure at its first place to where it stands and faces.
    pub(crate) fn carry(&self, time_secs: f64) -> DAffine3 {
        let (place, yaw) = self.body(time_secs);
        let turned = DQuat::from_rotation_y(yaw + self.turn_rad(time_secs));
        let axis = DQuat::from_rotation_y(yaw) * self.axis + place;
        DAffine3::from_rotation_translation(turned, axis - turned * self.axis)
    }
}

/// Returns the turns of the trunk with the roles.
fn turns(roles: &[RoleSpan], vigour: &Vigour<'_>) -> Vec<(f64, f64, [f64; 1])> {
    let mut targets = Vec::new();
    for (i, role) in roles.iter().enumerate() {
        let size = ROLE_TURN_RAD * role.side * vigour.size_at(role.start_secs).min(1.2);
        targets.push((role.start_secs - TURN_LEAD_SECS, TURN_SECS, [size]));
        let goes_on = roles
            .get(i + 1)
            .is_some_and(|next| next.start_secs - role.end_secs < DIALOGUE_SECS);
        if !goes_on {
            targets.push((role.end_secs - 0.1, TURN_SECS + 0.2, [0.0]));
        }
    }
    targets
}

/// Returns the turns of the trunk towards referents that are mentioned.
fn referent_turns(vigour: &Vigour<'_>) -> Vec<(f64, f64, [f64; 1])> {
    let mentions = &vigour.discourse.mentions;
    let mut targets = Vec::new();
    for (i, mention) in mentions.iter().enumerate() {
        let DVec3 { x, z, .. } = mention.place_in_figure;
        let aside = REFERENT_SHARE * ops::atan2(x, z.max(0.1));
        let turn = vigour.size_at(mention.start_secs).min(1.2)
            * aside.clamp(-REFERENT_TURN_RAD, REFERENT_TURN_RAD);
        targets.push((mention.start_secs - TURN_LEAD_SECS, TURN_SECS, [turn]));
        let next = mentions.get(i + 1);
        let goes_on = next.is_some_and(|next| next.start_secs - mention.end_secs < DIALOGUE_SECS);
        if !goes_on {
            targets.push((mention.end_secs + 0.3, TURN_SECS, [0.0]));
        }
    }
    targets
}

/// Returns the changes of place with the sentences.
fn changes(
    sentences: &[SentenceSpan],
    roles: &[RoleSpan],
    vigour: &Vigour<'_>,
    seed: u64,
) -> Vec<StandingChange> {
    let mut changes: Vec<StandingChange> = Vec::new();
    let mut last_secs = f64::NEG_INFINITY;
    let mut spoken_until = f64::NEG_INFINITY;
    for (i, sentence) in sentences.iter().enumerate() {
        let start = sentence.start_secs;
        let is_first = i == 0;
        let apart = APART_SECS[usize::from(!sentence.begins_paragraph)];
        let still = vigour.sorrow(start) > STILL_SORROW;
        if !is_first && !still && start - last_secs > apart {
            let side = RoleSpan::side_at(roles, start + 0.2).unwrap_or(0.0);
            // Chosen by the time and not by the number of the sentence, so that sentences that
            // are added or forgotten elsewhere change nothing.
            let bucket = (1e3 * start).round() as i64;
            let r = |id: u64| noise::signed(seed, stream::STEP + id, bucket);
            let before = changes.last().map_or(0.0, |change| change.to.x);
            // To the other side, as one who walks up and down does.
            let sideways = if before > 0.0 { -1.0 } else { 1.0 };
            let x = sideways * PLACE_M[0] * (0.65 + 0.35 * r(0));
            let yaw = ROLE_HEADING_RAD * side - sideways * HEADING_RAD * (0.5 + 0.5 * r(2));
            changes.push(StandingChange {
                at_secs: start - 0.1,
                to: Standing {
                    x: vigour.amount * x,
                    z: vigour.amount * PLACE_M[1] * r(1),
                    yaw: vigour.amount * yaw,
                },
            });
            last_secs = start;
        }
        if is_first {
            last_secs = start;
        }
        spoken_until = spoken_until.max(sentence.end_secs);
        let next = sentences.get(i + 1).map_or(f64::INFINITY, |s| s.start_secs);
        if next - spoken_until > HOME_SECS + 2.0 * CHANGE_SECS
            && changes.last().is_some_and(|c| c.to != Standing::default())
        {
            changes.push(StandingChange {
                at_secs: spoken_until + HOME_SECS,
                to: Standing::default(),
            });
            last_secs = spoken_until + HOME_SECS;
        }
    }
    changes
}
