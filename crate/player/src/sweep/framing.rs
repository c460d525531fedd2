//! Framing checks in landscape and portrait.

use raconteur_base::{DVec3, Side, ops};
use raconteur_body::Bone;
use raconteur_stage::{BROAD, Camera, Frame};

use super::Check;
use crate::Player;
use crate::lower::shots::MIN_SECS;

/// Sampling rate, hertz.
pub(super) const RATE_HZ: f64 = 15.0;
/// Aspects of typical displays, width over height.
const ASPECTS: [f64; 3] = [16.0 / 9.0, 1.0, 9.0 / 16.0];
/// Crown and chin from the joint of the skull, shares of stature: with hair, and with a beard.
const CROWN: f64 = 0.10;
const CHIN: f64 = 0.065;

/// Projects a point into an image: −1 to 1 from left to right and from bottom to top.
fn project(camera: &Camera, aspect: f64, place: DVec3) -> [f64; 2] {
    let towards = camera.target_in_world - camera.eye_in_world;
    let forward = towards.normalize_or(DVec3::NEG_Z);
    let right = forward.cross(DVec3::Y).normalize_or(DVec3::X);
    let to = place - camera.eye_in_world;
    let half = to.dot(forward).max(1e-6) * ops::tan(0.5 * camera.fov_y_rad);
    [
        to.dot(right) / (half * aspect),
        to.dot(right.cross(forward)) / half,
    ]
}

fn is_shown(camera: &Camera, aspect: f64, place: DVec3) -> bool {
    project(camera, aspect, place)
        .iter()
        .all(|x| x.abs() <= 1.0)
}

/// Points of a frame that the image should contain (skull and fingertips), world, metres.
pub(super) struct FramedPoints {
    skull: DVec3,
    /// Wrist, middle fingertip and thumb of the left and of the right hand.
    tips: [[DVec3; 3]; 2],
}

impl FramedPoints {
    pub(super) fn from_frame(frame: &Frame) -> Self {
        let at = |bone: Bone| frame.world_from_joint[bone.index()].translation;
        let tip = |side| ["wrist", "middle2", "thumb2"].map(|b| at(Bone::on(side, b)));
        Self {
            skull: at(Bone::Skull),
            tips: Side::BOTH.map(tip),
        }
    }
}

/// Visibility statistics for images of one aspect.
#[derive(Clone, Copy, Default)]
struct VisibleShare {
    /// Number of samples of a hand in a stroke, and of those with the hand outside the image.
    strokes: u32,
    out: u32,
    /// Time of the last one outside, seconds.
    out_secs: f64,
    last: Option<Camera>,
}

/// Framing statistics of a story: share of stroke time with hands outside the image (except
/// scripted close shots), distance of crown and chin from the edge, fastest zoom (also for emotion
/// shots), and shortfall of the duration of emotion shots.
pub(super) struct Framing {
    seen: [VisibleShare; ASPECTS.len()],
    face: Check,
    zoom: Check,
    near: Check,
    short: Check,
}

impl Framing {
    pub(super) fn new(player: &Player) -> Self {
        let mut short = Check::new("shot-short", 0.001, "s");
        for (start_secs, length_secs) in player.emotion_shots() {
            short.measure((MIN_SECS - length_secs).max(0.0), "shot", start_secs);
        }
        Self {
            seen: [VisibleShare::default(); ASPECTS.len()],
            face: Check::new("face-cut", 1.0, "of the picture"),
            zoom: Check::new("zoom", 10.0, "%/s"),
            near: Check::new("zoom-felt", 50.0, "%/s"),
            short,
        }
    }

    /// Measures the player's current frame, `RATE_HZ` times per second.
    pub(super) fn measure(&mut self, player: &Player, places: &FramedPoints, t: f64) {
        let stature_m = player.figure().skeleton.stature_m();
        for (seen, aspect) in self.seen.iter_mut().zip(ASPECTS) {
            let camera = player.camera(aspect);
            for y in [CROWN, -CHIN] {
                let place = project(&camera, aspect, places.skull + DVec3::Y * (y * stature_m));
                self.face
                    .measure(place[0].abs().max(place[1].abs()), "head", t);
            }
            for (side, tips) in Side::BOTH.into_iter().zip(places.tips) {
                // Hands may leave a narrower frame for a short time.
                if aspect >= BROAD && player.is_in_seen_stroke(side, t) {
                    seen.strokes += 1;
                    if !tips.iter().all(|p| is_shown(&camera, aspect, *p)) {
                        seen.out += 1;
                        seen.out_secs = t;
                    }
                }
            }
            let before = seen.last.replace(camera);
            if let Some(before) = before.filter(|b| b.eye_in_world == camera.eye_in_world) {
                let half = |c: &Camera| ops::tan(0.5 * c.fov_y_rad);
                let rate = ops::ln(half(&camera) / half(&before)).abs() * RATE_HZ;
                match player.sustained_shot(t - 1.0 / RATE_HZ, t) {
                    Some(true) => self.near.measure(100.0 * rate, "camera", t),
                    Some(false) => self.zoom.measure(100.0 * rate, "camera", t),
                    // It moves or cuts on purpose.
                    None => {}
                }
            }
        }
    }

    pub(super) fn checks(self) -> Vec<Check> {
        let mut hands = Check::new("hands-out", 2.0, "% of strokes");
        for seen in self.seen {
            if seen.strokes > 0 {
                let share = f64::from(seen.out) / f64::from(seen.strokes);
                hands.measure(100.0 * share, "hands", seen.out_secs);
            }
        }
        vec![hands, self.face, self.zoom, self.near, self.short]
    }
}
