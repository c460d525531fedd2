//! Properties of the conversion from face controls to a figure without tissue.

#![allow(clippy::expect_used, reason = "tests fail by panicking")]

use raconteur_actor::FaceRig;
use raconteur_base::{DQuat, noise};
use raconteur_body::face::{FaceControls, Jaw, MUSCLES, Muscle};
use raconteur_body::figure::{JAW_OPEN_RAD, MOUTH_CLOSE_RAD};
use raconteur_body::{Bone, Pose, Skeleton};

/// ARKit's 52, then those that our own figures have instead of halves.
const NAMES: &str = "eyeBlinkLeft eyeLookDownLeft eyeLookInLeft eyeLookOutLeft eyeLookUpLeft \
    eyeSquintLeft eyeWideLeft eyeBlinkRight eyeLookDownRight eyeLookInRight eyeLookOutRight \
    eyeLookUpRight eyeSquintRight eyeWideRight jawForward jawLeft jawRight jawOpen mouthClose \
    mouthFunnel mouthPucker mouthLeft mouthRight mouthSmileLeft mouthSmileRight \
    mouthFrownLeft mouthFrownRight mouthDimpleLeft mouthDimpleRight mouthStretchLeft \
    mouthStretchRight mouthRollLower mouthRollUpper mouthShrugLower mouthShrugUpper \
    mouthPressLeft mouthPressRight mouthLowerDownLeft mouthLowerDownRight mouthUpperUpLeft \
    mouthUpperUpRight browDownLeft browDownRight browInnerUp browOuterUpLeft browOuterUpRight \
    cheekPuff cheekSquintLeft cheekSquintRight noseSneerLeft noseSneerRight tongueOut \
    mouthPress mouthLowerDown mouthUpperUp tongueUp";

struct Face {
    names: Vec<String>,
    rig: FaceRig,
    weights: Vec<f32>,
    pose: Pose,
}

impl Face {
    fn new() -> Self {
        let names: Vec<String> = NAMES.split_whitespace().map(str::to_owned).collect();
        assert_eq!(names.len(), 56);
        Self {
            rig: FaceRig::from_parts(&Skeleton::example(), &names, [0.8; 2]),
            // Every target must be written.
            weights: vec![f32::NAN; names.len()],
            pose: Pose::zero(),
            names,
        }
    }

    fn show(&mut self, controls: &FaceControls) {
        self.rig
            .write(controls, [0.0; 2], &mut self.pose, &mut self.weights);
    }

    fn weight(&self, name: &str) -> f64 {
        let i = self.names.iter().position(|n| n == name);
        f64::from(self.weights[i.unwrap_or_else(|| panic!("no {name}"))])
    }

    /// Returns the approximate gap between the lips of the generated figures, mm: the jaw opening
    /// less the closing of `mouthClose`, plus the lips' own motion.
    fn gap_mm(&self) -> f64 {
        let jaw = self.weight("jawOpen") * JAW_OPEN_RAD;
        let closed = self.weight("mouthClose") * MOUTH_CLOSE_RAD;
        let lips = 4.2 * self.weight("mouthLowerDown") + 3.8 * self.weight("mouthUpperUp");
        90.0 * (jaw - closed)
            + lips
            + 6.0 * self.weight("mouthFunnel")
            + 1.6 * self.weight("noseSneerLeft")
            + 5.0 * self.weight("tongueOut")
    }
}

/// A face of random values; some are beyond their ranges.
fn random(seed: u64) -> FaceControls {
    let mut id = 0;
    let mut signed = |most: f64| {
        id += 1;
        // Half of the values are small, some are zero.
        let x = noise::signed(seed, id, 0);
        1.2 * most * x * noise::unit(seed, id, 1)
    };
    let mut controls = FaceControls::default();
    for c in &mut controls.contraction {
        *c = 1.5 * signed(1.0);
    }
    controls.protrusion = [signed(1.0), signed(1.0)];
    controls.seal = signed(1.0);
    controls.bite = signed(1.0);
    controls.jaw = Jaw {
        pitch_rad: signed(0.35),
        yaw_rad: signed(0.1),
        forward_m: signed(0.008),
        down_m: signed(0.004),
    };
    controls.upper_lid = [signed(1.0), signed(1.0)];
    controls.lower_lid = [signed(1.0), signed(1.0)];
    controls.tongue_tip = signed(1.0);
    controls.tongue_back = signed(1.0);
    controls.tongue_out = signed(1.0);
    controls.blush = signed(1.0);
    controls
}

fn mirrored(controls: &FaceControls) -> FaceControls {
    let mut other = *controls;
    for muscle in Muscle::all() {
        other.contraction[muscle.mirrored().index()] = controls.contraction[muscle.index()];
    }
    other.jaw.yaw_rad = -controls.jaw.yaw_rad;
    other.upper_lid.reverse();
    other.lower_lid.reverse();
    other
}

#[test]
fn nothing_asked_is_nothing_shown() {
    let mut face = Face::new();
    face.show(&FaceControls::default());
    assert!(face.weights.iter().all(|w| *w == 0.0), "{:?}", face.weights);
    assert_eq!(face.pose, Pose::zero());
}

#[test]
fn weights_are_shares_and_the_jaw_stays_in_its_joint_whatever_is_asked() {
    let mut face = Face::new();
    for seed in 0..3000 {
        let mut controls = random(seed);
        match seed % 50 {
            7 => controls.contraction[(seed % 38) as usize] = f64::NAN,
            17 => controls.jaw.pitch_rad = f64::INFINITY,
            27 => controls.seal = f64::NEG_INFINITY,
            37 => controls.upper_lid = [f64::NAN; 2],
            _ => {}
        }
        face.show(&controls);
        for (name, weight) in face.names.iter().zip(&face.weights) {
            assert!((0.0..=1.0).contains(weight), "{name}: {weight}, {seed}");
        }
        let chin = face.pose.rotation(Bone::Chin);
        assert!(
            (chin.length() - 1.0).abs() < 1e-12 && chin.angle_between(DQuat::IDENTITY) < 0.37,
            "the chin is a rotation within the range of the jaw"
        );
        assert!(
            face.pose.jaw_offset_in_skull.length() < Jaw::MAX_SLIDE_M,
            "the jaw slides less than its maximum"
        );
        for lid in face.pose.upper_lid_rad {
            assert!((-0.3..=0.8 + 1e-12).contains(&lid), "{lid}");
        }
    }
}

#[test]
fn a_mirrored_face_has_mirrored_weights() {
    let (mut face, mut other) = (Face::new(), Face::new());
    for seed in 0..1000 {
        let mut controls = random(seed);
        face.show(&controls);
        other.show(&mirrored(&controls));
        for (name, weight) in face.names.iter().zip(&face.weights) {
            let there = match (name.strip_suffix("Left"), name.strip_suffix("Right")) {
                (Some(part), _) => format!("{part}Right"),
                (_, Some(part)) => format!("{part}Left"),
                _ => name.clone(),
            };
            let found = other.weight(&there);
            assert!((f64::from(*weight) - found).abs() < 1e-6, "{name}");
        }
        // Both halves of a symmetric face are equal to the bit, and nothing moves sideways.
        for muscle in Muscle::all() {
            let own = controls.contraction[muscle.index()];
            controls.contraction[muscle.mirrored().index()] = own;
        }
        controls.jaw.yaw_rad = 0.0;
        controls.upper_lid[1] = controls.upper_lid[0];
        controls.lower_lid[1] = controls.lower_lid[0];
        face.show(&controls);
        for name in face.names.iter().filter_map(|n| n.strip_suffix("Left")) {
            let sides = ["Left", "Right"].map(|side| face.weight(&format!("{name}{side}")));
            assert_eq!(sides[0], sides[1], "{name}");
        }
        assert_eq!(
            (face.weight("mouthLeft"), face.weight("jawRight")),
            (0.0, 0.0)
        );
    }
}

#[test]
fn a_seal_closes_the_lips_whatever_else_the_face_does() {
    let mut face = Face::new();
    let mut open = 0;
    for seed in 0..3000 {
        let mut controls = random(seed);
        for c in &mut controls.contraction {
            *c = c.abs();
        }
        controls.jaw.pitch_rad = 0.12 * noise::unit(seed, 900, 0);
        controls.jaw.down_m = controls.jaw.down_m.abs();
        controls.seal = 0.0;
        face.show(&controls);
        open += usize::from(face.gap_mm() > 1.0);
        controls.seal = 1.0;
        face.show(&controls);
        assert!(face.gap_mm().abs() < 1e-3, "{seed}: {} mm", face.gap_mm());
    }
    assert!(open > 2500, "{open}");
}

#[test]
fn at_the_teeth_the_lower_lip_is_rolled_in_and_not_pulled_away() {
    let mut face = Face::new();
    for seed in 0..500 {
        let mut controls = random(seed);
        controls.bite = 1.0;
        controls.seal = 0.0;
        face.show(&controls);
        assert!(
            face.weight("mouthRollLower") >= 0.75 - 1e-6,
            "the lower lip is rolled in"
        );
        assert_eq!(face.weight("mouthLowerDown"), 0.0);
        assert_eq!(face.weight("mouthShrugLower"), 0.0);
        assert!(
            face.weight("mouthUpperUp") >= 0.25 - 1e-6,
            "the upper lip is raised"
        );
    }
}

/// Primary and permitted secondary effects of each muscle contracting alone (F&H section 3.1.1;
/// action units after Ekman and Friesen).
#[rustfmt::skip]
const ANATOMY: [(&str, &str, &str); 27] = [
    ("FrontalisMedial", "browInnerUp", ""),
    ("FrontalisLateral", "browOuterUp", ""),
    ("CorrugatorSupercilii", "browDown", ""),
    ("DepressorSupercilii", "browDown", ""),
    ("Procerus", "browDown", "noseSneer"),
    ("OrbicularisOculi", "eyeSquint", "cheekSquint"),
    ("Nasalis", "", ""),
    ("DepressorSeptiNasi", "", ""),
    ("LevatorLabiiSuperiorisAlaequeNasi", "noseSneer", "mouthUpperUp"),
    ("LevatorLabiiSuperioris", "mouthUpperUp", "noseSneer"),
    ("ZygomaticusMinor", "mouthUpperUp", "mouthSmile cheekSquint"),
    ("ZygomaticusMajor", "mouthSmile", "cheekSquint"),
    ("LevatorAnguliOris", "mouthSmile", "mouthUpperUp"),
    ("Risorius", "mouthStretch", "mouthSmile mouthDimple mouth"),
    ("Buccinator", "mouthDimple", "mouth"),
    ("DepressorAnguliOris", "mouthFrown", ""),
    ("DepressorLabiiInferioris", "mouthLowerDown", ""),
    ("Mentalis", "mouthShrugLower", "mouthShrugUpper"),
    ("OrbicularisOrisUpper", "mouthPress", "mouthPucker mouthRollUpper"),
    ("OrbicularisOrisLower", "mouthPress", "mouthPucker mouthRollLower"),
    ("Platysma", "mouthStretch", "mouthLowerDown"),
    ("Temporoparietalis", "", ""),
    ("AuricularisAnterior", "", ""),
    ("AuricularisSuperior", "", ""),
    ("AuricularisPosterior", "", ""),
    ("Masseter", "", ""),
    ("TransversusMenti", "", ""),
];

#[test]
fn a_muscle_alone_does_what_anatomy_says() {
    let mut face = Face::new();
    let mut seen = [false; MUSCLES];
    for (muscle, first, more) in ANATOMY {
        let sides = match Muscle::by_name(muscle) {
            Some(_) => &[("", "")][..],
            None => &[("Left", "Right"), ("Right", "Left")],
        };
        for (side, other) in sides {
            let name = format!("{muscle}{side}");
            let found = Muscle::by_name(&name).unwrap_or_else(|| panic!("no {name}"));
            seen[found.index()] = true;
            let mut controls = FaceControls::default();
            controls.contraction[found.index()] = 0.5;
            face.show(&controls);
            let moved: Vec<(&str, f32)> = face
                .names
                .iter()
                .map(String::as_str)
                .zip(face.weights.iter().copied())
                .filter(|(_, weight)| *weight > 0.0)
                .collect();
            let base = |n: &str| {
                let n = n
                    .strip_suffix("Left")
                    .or(n.strip_suffix("Right"))
                    .unwrap_or(n);
                n.to_owned()
            };
            for (target, _) in &moved {
                let part = base(target);
                let known = part == first || more.split_whitespace().any(|m| m == part);
                assert!(known, "{name} moves {target}");
                assert!(
                    other.is_empty() || !target.ends_with(other),
                    "{name}: {target}"
                );
            }
            for part in more
                .split_whitespace()
                .chain([first])
                .filter(|p| !p.is_empty())
            {
                let by = moved.iter().any(|(target, _)| base(target) == part);
                assert!(by, "{name} does not move {part}");
            }
            let most = moved.iter().map(|m| m.1).fold(0.0, f32::max);
            let firsts = moved.iter().filter(|(target, _)| base(target) == first);
            let firstly = firsts.map(|m| m.1).fold(0.0, f32::max);
            assert_eq!(firstly, most, "{name}: {moved:?}");
        }
    }
    assert!(seen.iter().all(|s| *s), "{seen:?}");
}

#[test]
fn small_changes_make_small_changes() {
    let mut face = Face::new();
    for seed in 0..150 {
        let (from, to) = (random(seed), random(seed + 5000));
        face.show(&from);
        let (mut last, mut lids) = (face.weights.clone(), face.pose.upper_lid_rad);
        for i in 1..=1000 {
            face.show(&from.lerp(&to, f64::from(i) * 1e-3));
            for (k, (a, b)) in last.iter().zip(&face.weights).enumerate() {
                assert!((a - b).abs() < 0.008, "{}: {a} {b}", face.names[k]);
            }
            for (a, b) in lids.iter().zip(face.pose.upper_lid_rad) {
                assert!(
                    (a - b).abs() < 0.01,
                    "small changes of the input make small changes"
                );
            }
            last.copy_from_slice(&face.weights);
            lids = face.pose.upper_lid_rad;
        }
    }
}
