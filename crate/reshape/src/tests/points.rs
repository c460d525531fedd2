//! Points of the skin: rays that pick them, and the texture chart around them.

use raconteur_base::noise;

use super::look::with;
use super::*;

#[test]
fn a_ray_meets_the_skin_that_it_is_aimed_at() {
    let reshaper = sofia();
    let figure = with(&reshaper, &Look::default(), [1.0; 3]);
    let skull = figure.inverse_bind[Bone::Skull.index()].inverse();
    let skin = &figure.meshes[reshaper.head];
    let mut met = 0;
    for i in 0..200 {
        let t = noise::unit(4, 4, i) * reshaper.triangles.len() as f64;
        let triangle = reshaper.triangles[t as usize];
        let corners = triangle.map(|v| wide(skin.positions[v as usize]));
        let middle = corners.iter().sum::<DVec3>() / 3.0;
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
        let Some(normal) = normal.try_normalize() else {
            continue;
        };
        // From so near that nothing is in between.
        let spot = reshaper.pick(&figure, &skull, middle + normal * 2e-4, -normal);
        let spot = spot.expect("skin");
        let place: DVec3 = (0..3)
            .map(|k| wide(skin.positions[spot.corners[k] as usize]) * spot.shares[k])
            .sum();
        assert!(
            (place - middle).length() < 3e-4,
            "{}",
            (place - middle).length()
        );
        met += usize::from(spot.corners == triangle);
    }
    assert!(met > 180, "{met}");
    assert_eq!(reshaper.pick(&figure, &skull, DVec3::ZERO, DVec3::Z), None);
}

/// The texture coordinates of a triangle's corners match the chart of its centre.
#[test]
fn a_chart_tells_where_its_neighbours_are() {
    let reshaper = sofia();
    let figure = &reshaper.figure;
    let skin = &figure.meshes[reshaper.head];
    let mut charts = 0;
    for corners in reshaper.triangles.iter().step_by(37).copied() {
        let spot = SurfacePoint {
            corners,
            shares: [1.0 / 3.0; 3],
        };
        let Some(chart) = reshaper.chart(figure, &spot) else {
            continue;
        };
        charts += 1;
        let places = corners.map(|v| wide(skin.positions[v as usize]));
        let middle = places.iter().sum::<DVec3>() / 3.0;
        let normal = (places[1] - places[0]).cross(places[2] - places[0]);
        let normal = normal.normalize();
        let upright = if normal.y.abs() > 0.9 {
            DVec3::Z
        } else {
            DVec3::Y
        };
        let up = (upright - normal * upright.dot(normal)).normalize();
        let right = up.cross(normal);
        for (place, v) in places.iter().zip(corners) {
            let off = *place - middle;
            for i in 0..2 {
                let told =
                    chart.uv[i] + chart.right[i] * off.dot(right) + chart.up[i] * off.dot(up);
                let own = f64::from(skin.uvs[v as usize][i]);
                assert!((told - own).abs() < 1e-5, "{told} {own}");
            }
        }
    }
    assert!(charts > 300, "{charts}");
    let numbers = |n: &[f64]| SurfacePoint::from_numbers(n);
    assert!(
        numbers(&[1.0, 2.0, 3.0, 0.2, 0.3, 0.5]).is_some(),
        "six valid numbers form a chart"
    );
    for broken in [
        &[1.0; 5][..],
        &[1.5, 2.0, 3.0, 0.2, 0.3, 0.5],
        &[-1.0, 2.0, 3.0, 0.2, 0.3, 0.5],
        &[1.0, 2.0, f64::NAN, 0.2, 0.3, 0.5],
    ] {
        assert_eq!(numbers(broken), None);
    }
    let far = SurfacePoint {
        corners: [VERTICES as u32; 3],
        shares: [1.0, 0.0, 0.0],
    };
    assert_eq!(reshaper.chart(figure, &far), None);
}
