//! Tests of the time functions: start values, continuity and preserved values.

use super::*;

const NOW: RigidFrame = RigidFrame {
    position: DVec3::new(0.3, 1.1, 0.2),
    rotation: DQuat::IDENTITY,
};

fn path(shape: PathShape, looping: bool) -> Path {
    Path {
        shape,
        from: Placement::default(),
        to: Placement::default(),
        period_secs: 2.0,
        looping,
    }
}

fn round(turns: f64, rise: f64) -> PathShape {
    PathShape::Round {
        centre: Placement::default(),
        normal: DVec3::ZERO,
        radii: [0.1, 0.2],
        from_rad: 0.0,
        turns,
        rise,
    }
}

#[test]
fn angles_and_rotations_convert_both_ways() {
    for i in 0..200 {
        let r = |k| raconteur_base::noise::signed(5, k, i);
        let angles = [3.0 * r(0), 1.5 * r(1), 3.0 * r(2)];
        let q = rotation_from(angles);
        assert!(
            rotation_from(angles_of(q)).angle_between(q) < 1e-7,
            "the angles of a rotation round trip"
        );
    }
    let down = rotation_from([0.4, core::f64::consts::FRAC_PI_2, 0.0]);
    assert!(
        rotation_from(angles_of(down)).angle_between(down) < 1e-6,
        "the angles at the pole round trip"
    );
}

#[test]
fn open_ends_are_where_the_limb_is() {
    let mut segment = path(PathShape::Segment, false);
    segment.to.position[1] = Some(1.5);
    let curve = TimedPath::new(&segment, &NOW, true);
    assert!(
        curve.sample(0.0).position.distance(NOW.position) < 1e-12,
        "an open start begins at the limb"
    );
    let middle = curve.sample(1.0).position;
    assert!(
        middle.distance(DVec3::new(0.3, 1.3, 0.2)) < 1e-9,
        "the middle of the path"
    );
    assert!(
        curve
            .sample(9.0)
            .position
            .distance(DVec3::new(0.3, 1.5, 0.2))
            < 1e-9,
        "the path ends at its goal"
    );
}

#[test]
fn nothing_jumps_not_even_where_a_loop_closes() {
    let mut far = path(PathShape::Segment, true);
    far.from.position = [Some(0.5), Some(1.4), Some(0.0)];
    far.to.position = [Some(0.1), Some(0.9), Some(0.4)];
    far.to.angles[0] = Some(1.0);
    let eight = PathShape::Lemniscate {
        centre: Placement::default(),
        normal: DVec3::X,
        half_width: 0.2,
        tilt_rad: 0.5,
        turns: 1.0,
    };
    let wave = PathShape::Sinusoid {
        across: DVec3::Y * 0.1,
        cycles: 3.0,
    };
    let bezier = PathShape::Bezier {
        controls: [Placement::default(); 2],
    };
    let hermite = PathShape::Hermite {
        tangents: [DVec3::X, DVec3::Y],
    };
    let all = [
        round(1.0, 0.0),
        round(-2.0, 0.3),
        eight,
        wave,
        bezier,
        hermite,
    ];
    let paths = all.into_iter().map(|s| path(s, true)).chain([far]);
    for path in paths {
        let curve = TimedPath::new(&path, &NOW, false);
        assert!(
            curve.sample(0.0).position.distance(NOW.position) < 1e-9,
            "the path begins at the limb"
        );
        let mut last = curve.sample(0.0);
        for i in 1..800 {
            let next = curve.sample(f64::from(i) * 0.01);
            let step = next.position.distance(last.position);
            assert!(step < 0.04, "{path:?} at {i}: {step}");
            assert!(
                next.rotation.angle_between(last.rotation) < 0.1,
                "the rotation does not jump between samples"
            );
            assert!(
                next.rotation.is_normalized(),
                "the sampled rotation is normalised"
            );
            last = next;
        }
    }
}

#[test]
fn a_circle_keeps_its_radii_and_a_helix_rises() {
    let curve = TimedPath::new(&path(round(1.0, 0.3), false), &NOW, false);
    let quarter = curve.sample(0.5).position - NOW.position;
    assert!(
        quarter.distance(DVec3::new(-0.1, 0.2, 0.075)) < 1e-9,
        "{quarter}"
    );
    let end = curve.sample(2.0).position - NOW.position;
    assert!(end.distance(DVec3::new(0.0, 0.0, 0.3)) < 1e-9, "{end}");
}
