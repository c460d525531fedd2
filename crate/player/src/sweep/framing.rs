//! Whether the picture holds what it should, in landscape and in portrait.

use raconteur_base::{DVec3, Side, ops};
use raconteur_body::Bone;
use raconteur_stage::Camera;

use super::Check;
use crate::Player;
use crate::lower::shots::SHORTEST_SECS;

/// Looks a second.
const RATE_HZ: f64 = 15.0;
/// Pictures that stories are seen in, width over height.
const ASPECTS: [f64; 3] = [16.0 / 9.0, 1.0, 9.0 / 16.0];
/// Crown and chin from the joint of the skull, shares of stature: with hair, and with a beard.
const CROWN: f64 = 0.10;
const CHIN: f64 = 0.065;

/// Where a place lies in a picture: −1 to 1 from left to right and from below to above.
fn shown(camera: &Camera, aspect: f64, place: DVec3) -> [f64; 2] {
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
    shown(camera, aspect, place).iter().all(|x| x.abs() <= 1.0)
}

/// Share of the strokes' time, written close shots aside, in which wrist and fingertips are out of the
/// picture, how far crown and chin come to its edge, the fastest zoom, that of shots that emotions ask
/// for apart, and what such a shot lacks to the shortest, over a story.
pub(super) fn framing(player: &mut Player) -> Vec<Check> {
    let mut hands = Check::new("hands-out", 2.0, "% of strokes");
    let mut face = Check::new("face-cut", 1.0, "of the picture");
    let mut zoom = Check::new("zoom", 10.0, "%/s");
    let mut near = Check::new("zoom-felt", 50.0, "%/s");
    let mut short = Check::new("shot-short", 0.001, "s");
    for (start_secs, length_secs) in player.felt_shots() {
        short.measure((SHORTEST_SECS - length_secs).max(0.0), "shot", start_secs);
    }
    for aspect in ASPECTS {
        let (mut out, mut all) = (0u32, 0u32);
        let mut last: Option<Camera> = None;
        for i in 0..=(player.end_secs() * RATE_HZ) as u64 {
            let t = i as f64 / RATE_HZ;
            let frame = player.frame(t, aspect);
            let camera = frame.camera;
            let at = |bone: Bone| frame.world_from_joint[bone.index()].translation;
            let skull = at(Bone::Skull);
            let tips = Side::BOTH
                .map(|side| ["wrist", "middle2", "thumb2"].map(|b| at(Bone::on(side, b))));
            let stature_m = player.figure().skeleton.stature_m();
            for y in [CROWN, -CHIN] {
                let place = shown(&camera, aspect, skull + DVec3::Y * (y * stature_m));
                face.measure(place[0].abs().max(place[1].abs()), "head", t);
            }
            for (side, tips) in Side::BOTH.into_iter().zip(tips) {
                if player.is_in_seen_stroke(side, t) {
                    all += 1;
                    out += u32::from(!tips.iter().all(|p| is_shown(&camera, aspect, *p)));
                }
            }
            if let Some(before) = last.filter(|b| b.eye_in_world == camera.eye_in_world) {
                let half = |c: &Camera| ops::tan(0.5 * c.fov_y_rad);
                let rate = ops::ln(half(&camera) / half(&before)).abs() * RATE_HZ;
                match player.kept_shot(t - 1.0 / RATE_HZ, t) {
                    Some(true) => near.measure(100.0 * rate, "camera", t),
                    Some(false) => zoom.measure(100.0 * rate, "camera", t),
                    // It moves or cuts on purpose.
                    None => {}
                }
            }
            last = Some(camera);
        }
        if all > 0 {
            hands.measure(100.0 * f64::from(out) / f64::from(all), "hands", 0.0);
        }
    }
    vec![hands, face, zoom, near, short]
}
