//! Tests of hand shapes: fingers have their intended contacts and do not pass through each other.
//!
//! Every phalanx is sampled at eight points; there it is the ellipse of its section (see
//! [`super::anatomy`]), swept slightly along the bone. The penetration of two samples is the sum of
//! their radii towards each other minus the distance of their centres. Neighbours are compared
//! beyond the web, segments of one finger from one and a quarter bone lengths on.

use raconteur_base::{DAffine3, DVec3, Side, ops};

use super::anatomy::FINGER_COUNT;
use super::tests::{skeleton_with, solved};
use super::weights::finger_bone;
use super::*;
use raconteur_body::hand_shape::HandShape;

struct Sample {
    /// Joint coordinate, 0 to 3.
    q: f64,
    centre: DVec3,
    along: DVec3,
    /// Half axes of the contact ellipse towards the back of the finger and sideways.
    dorsal: DVec3,
    lateral: DVec3,
}

impl Sample {
    fn radius(&self, way: DVec3) -> f64 {
        let (h, w) = (self.dorsal.length(), self.lateral.length());
        let (a, b) = (way.dot(self.dorsal) / h, way.dot(self.lateral) / w);
        let across = ops::hypot(a, b);
        if across < 1e-6 {
            return h.min(w);
        }
        let ellipse = 1.0 / ops::hypot(a / across / h, b / across / w);
        ellipse * across + (1.0 - across) * ellipse.min(h)
    }
}

/// A hand's samples in the frames of their bones, and its skeleton.
struct Model {
    side: Side,
    skeleton: raconteur_body::skeleton::Skeleton,
    rest: [Vec<(Bone, Sample)>; FINGER_COUNT],
}

impl Model {
    fn new(params: &HandParams, side: Side) -> Self {
        let anatomy = Anatomy::new(HandBuild::from_sex_and_age(params.sex, params.age_years));
        let field = Field::new(&anatomy);
        let cage = cage::build(&anatomy, &field);
        let skin = surface::build(&anatomy, &field, &cage);
        let place = Placement::new(params, side, &skin);
        let hand = build(params, side);
        let skeleton = skeleton_with(&hand, side);
        let wrist = zero_frames()[Bone::on(side, "wrist").index()];
        let rest = core::array::from_fn(|f| {
            let finger = &anatomy.fingers[f];
            let mut samples = Vec::new();
            for i in 0..24 {
                let q = (f64::from(i) + 0.5) / 8.0;
                if q > 2.72 {
                    continue;
                }
                let bone = finger_bone(side, f, (q as usize).min(2));
                let find = |list: &[(Bone, DVec3)]| list.iter().find(|b| b.0 == bone).unwrap().1;
                let turn = hand.bind_in_wrist.iter().find(|b| b.0 == bone).unwrap().1;
                let into = |v: DVec3| (wrist * turn).inverse() * v;
                let s = finger.section(finger.along(q));
                let at = finger.along(q);
                let axis = DVec3::new(0.0, at, (s.palmar - s.dorsal) / 2.0);
                let centre = place.position(finger.point(axis)) - find(&hand.joints);
                let vector = |v: DVec3| into(place.position(v));
                samples.push((
                    bone,
                    Sample {
                        q,
                        centre: into(centre),
                        along: vector(finger.frame.y_axis).normalize(),
                        dorsal: vector(-finger.frame.z_axis * (s.dorsal + s.palmar) / 2.0),
                        lateral: vector(finger.frame.x_axis * s.half_width),
                    },
                ));
            }
            samples
        });
        Self {
            side,
            skeleton,
            rest,
        }
    }

    /// Samples of a shape, fingers counted thumb 0 to little finger 4.
    fn posed(&self, angles: &HandAngles) -> [Vec<Sample>; FINGER_COUNT] {
        let world: Vec<DAffine3> = solved(&self.skeleton, self.side, angles);
        core::array::from_fn(|f| {
            self.rest[f]
                .iter()
                .map(|(bone, s)| {
                    let m = world[bone.index()];
                    let turn = |v: DVec3| m.transform_vector3(v);
                    Sample {
                        q: s.q,
                        centre: m.transform_point3(s.centre),
                        along: turn(s.along),
                        dorsal: turn(s.dorsal),
                        lateral: turn(s.lateral),
                    }
                })
                .collect()
        })
    }
}

/// Returns the penetration depth of two samples, metres; negative is a gap.
fn entry(a: &Sample, b: &Sample) -> f64 {
    let d = b.centre - a.centre;
    let length = d.length();
    let way = d / length.max(1e-9);
    a.radius(way) + b.radius(-way) - length
}

fn comparable(f: usize, a: &Sample, g: usize, b: &Sample) -> bool {
    if f == g {
        return a.q + 1.25 <= b.q;
    }
    // The ball of the thumb is part of the palm.
    let free = |f: usize, s: &Sample| f > 0 || s.q >= 0.75;
    let beyond_web = f == 0 || g - f > 1 || a.q >= 0.55 || b.q >= 0.55;
    free(f, a) && free(g, b) && beyond_web
}

fn worst(posed: &[Vec<Sample>; FINGER_COUNT]) -> (f64, String) {
    let mut worst = (f64::NEG_INFINITY, String::new());
    for f in 0..FINGER_COUNT {
        for g in f..FINGER_COUNT {
            for a in &posed[f] {
                for b in posed[g].iter().filter(|b| comparable(f, a, g, b)) {
                    let e = entry(a, b);
                    if e > worst.0 {
                        worst = (e, format!("finger {f} at {:.2}, {g} at {:.2}", a.q, b.q));
                    }
                }
            }
        }
    }
    worst
}

/// Returns the gap between a segment of one finger and a segment of another in a pose; negative
/// where they overlap.
fn gap(posed: &[Vec<Sample>; FINGER_COUNT], a: (usize, usize), b: (usize, usize)) -> f64 {
    let segment = |(f, k): (usize, usize)| posed[f].iter().filter(move |s| s.q as usize == k);
    segment(a)
        .flat_map(|x| segment(b).map(move |y| -entry(x, y)))
        .fold(f64::INFINITY, f64::min)
}

fn woman() -> Model {
    Model::new(&mean_hand(1.0, 35.0, 1.66, [0.5; 3]), Side::Left)
}

#[test]
fn fingers_of_no_shape_pass_through_each_other() {
    let model = woman();
    for shape in HandShape::ALL {
        let (entry, where_) = worst(&model.posed(shape.angles()));
        assert!(
            entry < 0.002,
            "{} {}: {:.1} mm, {where_}",
            shape.id(),
            shape.name(),
            entry * 1000.0
        );
    }
}

#[test]
fn other_hands_hold_the_shapes_too() {
    for (sex, age, stature) in [(0.0, 35.0, 1.756), (0.0, 70.0, 1.72), (0.0, 9.0, 1.34)] {
        let model = Model::new(&mean_hand(sex, age, stature, [0.5; 3]), Side::Right);
        for shape in HandShape::ALL {
            let (entry, where_) = worst(&model.posed(shape.angles()));
            // Angles are solved for one hand; thicker fingers press a little deeper.
            assert!(
                entry < 0.0035,
                "{age} {} {}: {:.1} mm, {where_}",
                shape.id(),
                shape.name(),
                entry * 1000.0
            );
        }
    }
}

#[test]
fn pads_meet_in_pinches_and_the_thumb_lies_on_the_fist() {
    let model = woman();
    let touching = [
        (24, (0, 2), (1, 2)),
        (27, (0, 2), (1, 2)),
        (11, (0, 2), (1, 2)),
        (44, (0, 2), (1, 2)),
        (44, (0, 2), (2, 2)),
        (23, (0, 2), (2, 2)),
        (55, (0, 2), (2, 2)),
        (14, (0, 2), (2, 1)),
        (19, (0, 2), (2, 1)),
        (38, (0, 2), (3, 1)),
    ];
    for (id, a, b) in touching {
        let posed = model.posed(HandShape::ALL[id].angles());
        let gap = gap(&posed, a, b);
        assert!(gap.abs() < 0.002, "shape {id}: {:.1} mm", gap * 1000.0);
    }
}

#[test]
fn crossed_fingers_cross() {
    let posed = woman().posed(HandShape::ALL[42].angles());
    let tip = |f: usize| posed[f].last().unwrap();
    // Left hand: the thumb's side is the front.
    assert!(
        tip(2).centre.z > tip(1).centre.z,
        "the middle finger lies before the index"
    );
    assert!(tip(2).centre.y > tip(1).centre.y, "and over it");
}
