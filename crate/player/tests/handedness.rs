//! Left-handers: their performance is the mirror image of a right-hander's.

mod common;

use std::fmt::Write as _;
use std::sync::Arc;

use common::perform;
use raconteur_player::base::{Side, mirror_vector, noise};
use raconteur_player::body::{Bone, Figure, Skeleton};
use raconteur_player::{Options, Player};

/// Rounding of angles and of sums in another order, metres.
const ALIKE_M: f64 = 1e-6;

/// The example of GEVH table A.1, which is its own mirror image.
fn figure(dominant_hand: Side) -> Arc<Figure> {
    Arc::new(Figure {
        name: "example".to_owned(),
        skeleton: Skeleton::example(),
        inverse_bind: Vec::new(),
        meshes: Vec::new(),
        morph_names: Vec::new(),
        lid_closure_rad: [0.0; 2],
        sex: None,
        dominant_hand,
        images: Vec::new(),
        tissue: None,
        springs: raconteur_body::Springs::default(),
    })
}

/// Handedness of the gestures in a script.
const ALL: [&str; 5] = ["both", "left", "right", "dominant", "non-dominant"];
const RELATIVE: [&str; 3] = ["both", "dominant", "non-dominant"];

/// Returns a script of random gestures of some kinds, mirrored or not; `head` precedes its body.
fn script(seed: u64, kinds: &[&str], head: &str, mirrored: bool) -> String {
    let sign = if mirrored { -1.0 } else { 1.0 };
    let mut body = String::new();
    for i in 0..6 {
        let u = |k| noise::unit(seed, k, i);
        let kind = kinds[(u(0) * kinds.len() as f64) as usize];
        let hands = match (kind, mirrored) {
            ("left", true) => "right",
            ("right", true) => "left",
            _ => kind,
        };
        let (time, secs) = (1.0 + 1.3 * i as f64, 0.3 + 0.5 * u(1));
        let mut keys = String::new();
        for k in 0..1 + (2.0 * u(2)) as i64 {
            let v = |c: u64| noise::signed(seed, 20 + c, 10 * i + k);
            let (x, y, z) = (
                sign * (6.0 * v(0) - 8.0),
                16.0 + 8.0 * v(1),
                -14.0 + 3.0 * v(2),
            );
            let _ = write!(
                keys,
                "<key time='{}' x='{x}' y='{y}' z='{z}'/>",
                0.2 * k as f64
            );
        }
        let (a, x, y) = (sign * 90.0 * u(3), sign * (u(4) - 0.5), 0.5 + u(5));
        let shape = (60.0 * u(6)) as u32;
        let _ = write!(
            body,
            "<gesture-key time='{time}' duration='{secs}' handedness='{hands}'>\
             <hand-shapes><key id='{shape}'/></hand-shapes>\
             <palms><key a='{a}' x='{x}' y='{y}' z='-0.4'/></palms>\
             <motion>{keys}</motion></gesture-key>"
        );
    }
    format!("<eml xmlns:r='urn:raconteur:eml:1'>{head}<body>{body}<null time='10'/></body></eml>")
}

fn player(eml: &str, figure: Side, handedness: Option<Side>) -> Player {
    let options = Options {
        motion_amount: 0.0,
        handedness,
        ..Options::default()
    };
    let loaded = perform(eml, None, self::figure(figure), options);
    let errors = loaded
        .diagnostics
        .iter()
        .filter(|d| d.code.starts_with("eml"));
    assert_eq!(errors.count(), 0, "{:?}\n{eml}", loaded.diagnostics);
    loaded.player
}

/// The farthest that a joint of one performance is from the mirror image of the other's,
/// metres.
fn unlike_m(a: &mut Player, b: &mut Player) -> f64 {
    let mut worst = 0.0_f64;
    for i in 0..200 {
        let t = 0.05 * f64::from(i);
        let seen = a.frame(t, 1.6).world_from_joint.clone();
        let other = &b.frame(t, 1.6).world_from_joint;
        for bone in Bone::ALL {
            let place = mirror_vector(seen[bone.index()].translation);
            let off = place.distance(other[bone.mirrored().index()].translation);
            worst = worst.max(off);
        }
    }
    worst
}

#[test]
fn a_script_for_a_left_hander_is_the_mirror_image_of_the_mirrored_script_for_a_right_hander() {
    for seed in 0..24 {
        let head = |hand: &str| format!("<head><r:performer handedness='{hand}'/></head>");
        let left = script(seed, &ALL, &head("left"), false);
        let right = script(seed, &ALL, &head("right"), true);
        // The script takes precedence over the figure.
        let mut left = player(&left, Side::Right, None);
        let mut right = player(&right, Side::Left, None);
        let off = unlike_m(&mut left, &mut right);
        assert!(off < ALIKE_M, "seed {seed}: {off} m");
    }
}

#[test]
fn a_left_hander_mirrors_what_is_written_for_the_dominant_hand() {
    for seed in 0..24 {
        let text = script(seed, &RELATIVE, "", false);
        let mut right = player(&text, Side::Right, None);
        // A left-handed figure, and a right-handed one performed as a left-hander.
        for mut left in [
            player(&text, Side::Left, None),
            player(&text, Side::Right, Some(Side::Left)),
        ] {
            let off = unlike_m(&mut left, &mut right);
            assert!(off < ALIKE_M, "seed {seed}: {off} m");
        }
        // The host takes precedence over story and figure: the right hand is dominant again.
        let head = "<head><r:performer handedness='left'/></head>";
        let mut told = player(&script(seed, &RELATIVE, head, true), Side::Left, None);
        let mut shown = player(
            &script(seed, &RELATIVE, head, true),
            Side::Left,
            Some(Side::Right),
        );
        let off = unlike_m(&mut told, &mut shown);
        assert!(off < ALIKE_M, "seed {seed}: {off} m");
    }
}

#[test]
fn left_and_right_mean_left_and_right_whoever_performs() {
    for seed in 0..8 {
        let text = script(seed, &["left", "right"], "", false);
        let right = player(&text, Side::Right, None);
        let left = player(&text, Side::Left, None);
        let mut count = 0;
        for side in Side::BOTH {
            assert_eq!(right.strokes(side), left.strokes(side), "seed {seed}");
            count += left.strokes(side).len();
        }
        assert!(count > 0, "seed {seed}");
    }
}
