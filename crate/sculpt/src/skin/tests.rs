//! Invariants of the atlas and the baked maps.

use std::sync::OnceLock;

use raconteur_base::{DVec2, DVec3, Side};

use super::SkinParams;
use super::bake::{SkinMaps, bake};
use super::expression_lines::ExpressionMarks;
use crate::atlas::{Raster, SIZE};
use crate::hand;
use crate::hand::HandSheet;
use crate::head;
use crate::head::HeadSheet;
use crate::people::preset;

/// A head and a hand, made once for all tests.
fn sheets() -> &'static (HeadSheet, HandSheet) {
    static MADE: OnceLock<(HeadSheet, HandSheet)> = OnceLock::new();
    MADE.get_or_init(|| {
        let p = preset("sofia").unwrap();
        let head = head::build(&p.person, &p.head);
        let hand = hand::build(
            &hand::mean_hand(1.0, 35.0, 1.66, [0.5, 0.3, 0.2]),
            Side::Right,
        );
        (head.sheet, hand.sheet)
    })
}

fn elder() -> SkinParams {
    SkinParams {
        age_years: 72.0,
        freckles: 0.3,
        moles: 6,
        sun: 0.8,
        vessels: 0.6,
        beard: 0.6,
        short_beard: 0.2,
        ..SkinParams::plain()
    }
}

fn baked() -> &'static SkinMaps {
    static MADE: OnceLock<SkinMaps> = OnceLock::new();
    MADE.get_or_init(|| bake(&elder(), &sheets().0, &sheets().1, None))
}

/// Texels a millimetre along the surface's two main directions, largest first.
fn densities(uv: [[f64; 2]; 3], at: [DVec3; 3]) -> [f64; 2] {
    let (e, f) = (at[1] - at[0], at[2] - at[0]);
    let x = e.normalize_or_zero();
    let local = [DVec2::new(e.length(), 0.0), {
        let along = f.dot(x);
        DVec2::new(along, (f.length_squared() - along * along).max(0.0).sqrt())
    }];
    let [a, b, c] = uv.map(|p| DVec2::from_array(p) * SIZE as f64);
    let (s, r) = (b - a, c - a);
    // Jacobian of the atlas over the surface, by columns.
    let whole = local[0].perp_dot(local[1]).max(1e-9);
    let jx = (s * local[1].y - r * local[0].y) / whole;
    let jy = (r * local[0].x - s * local[1].x) / whole;
    let (p, q) = (jx.length_squared() + jy.length_squared(), jx.perp_dot(jy));
    let root = (p * p / 4.0 - q * q).max(0.0).sqrt();
    [(p / 2.0 + root).sqrt(), (p / 2.0 - root).max(0.0).sqrt()]
}

struct Row {
    density: [f64; 2],
    area: f64,
    at: DVec3,
    normal: DVec3,
}

fn rows(uv: &[[f64; 2]], triangles: &[[u32; 3]], at: &[DVec3], normals: &[DVec3]) -> Vec<Row> {
    triangles
        .iter()
        .map(|t| {
            let p = t.map(|v| at[v as usize]);
            Row {
                density: densities(t.map(|v| uv[v as usize]), p),
                area: (p[1] - p[0]).cross(p[2] - p[0]).length() / 2.0,
                at: (p[0] + p[1] + p[2]) / 3.0,
                normal: normals[t[0] as usize],
            }
        })
        .collect()
}

/// Returns the value below which a share of the area lies.
fn quantile(mut values: Vec<(f64, f64)>, share: f64) -> f64 {
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = values.iter().map(|v| v.1).sum();
    let mut gone = 0.0;
    for (x, area) in values {
        gone += area;
        if gone >= share * whole {
            return x;
        }
    }
    f64::NAN
}

#[test]
fn no_seen_skin_overlaps_in_the_atlas_and_all_of_it_is_inside() {
    let (head, hand) = sheets();
    let base = head.uv.len() as u32;
    let uv: Vec<[f64; 2]> = head.uv.iter().chain(&hand.uv).copied().collect();
    let moved = hand.triangles.iter().map(|t| t.map(|v| v + base));
    let triangles: Vec<[u32; 3]> = head.triangles.iter().copied().chain(moved).collect();
    for t in &triangles {
        for v in t {
            assert!(
                uv[*v as usize].iter().all(|x| (0.004..0.996).contains(x)),
                "the texture coordinates are inside the margin"
            );
        }
    }
    let raster = Raster::new(&uv, &triangles);
    let inside = raster.hits.iter().flatten().filter(|h| h.inside).count();
    println!(
        "covered {:.3}, overlaps {}",
        inside as f64 / (SIZE * SIZE) as f64,
        raster.overlaps
    );
    // A texel's centre may lie on the edge of two triangles.
    assert!(raster.overlaps <= 3, "{}", raster.overlaps);
    assert!(inside * 2 > SIZE * SIZE, "{inside}");
}

#[test]
fn faces_look_the_same_way_in_the_atlas() {
    // Seen from outside, a triangle has the same winding in the image: no mirrored text.
    let (head, hand) = sheets();
    for (uv, triangles) in [(&head.uv, &head.triangles), (&hand.uv, &hand.triangles)] {
        let turned = triangles
            .iter()
            .filter(|t| {
                let [a, b, c] = t.map(|v| DVec2::from_array(uv[v as usize]));
                (b - a).perp_dot(c - a) > 0.0
            })
            .count();
        assert!(
            turned * 500 <= triangles.len(),
            "{turned} of {}",
            triangles.len()
        );
    }
}

#[test]
fn the_face_gets_its_texels_and_is_little_stretched() {
    let (head, hand) = sheets();
    let face: Vec<Row> = rows(&head.uv, &head.triangles, &head.mean, &head.normals)
        .into_iter()
        .filter(|r| {
            r.at.x.abs() < 50.0
                && (-90.0..78.0).contains(&r.at.y)
                && r.at.z > 62.0
                && r.normal.z > 0.3
        })
        .collect();
    let fewest = |rows: &[Row]| {
        rows.iter()
            .map(|r| (r.density[1], r.area))
            .collect::<Vec<_>>()
    };
    let mean = |rows: &[Row]| {
        rows.iter()
            .map(|r| ((r.density[0] * r.density[1]).sqrt(), r.area))
            .collect::<Vec<_>>()
    };
    let stretch = |rows: &[Row]| {
        rows.iter()
            .map(|r| (r.density[0] / r.density[1].max(1e-6), r.area))
            .collect::<Vec<_>>()
    };
    let back: Vec<Row> = rows(&hand.uv, &hand.triangles, &hand.at, &hand.normals)
        .into_iter()
        .filter(|r| r.at.y > 0.0)
        .collect();
    for (name, r) in [("face", &face), ("hand", &back)] {
        println!(
            "{name}: mm a texel, median {:.3}, 95 % below {:.3}; stretch median {:.2}, 95 % {:.2}",
            1.0 / quantile(mean(r), 0.5),
            1.0 / quantile(fewest(r), 0.05),
            quantile(stretch(r), 0.5),
            quantile(stretch(r), 0.95)
        );
    }
    assert!(
        1.0 / quantile(mean(&face), 0.5) < 0.36,
        "the median texel of the face is below 0.36 mm"
    );
    assert!(
        1.0 / quantile(fewest(&face), 0.05) < 0.75,
        "the sparsest texels of the face are below 0.75 mm"
    );
    assert!(
        quantile(stretch(&face), 0.95) < 2.7,
        "95 % of the face is stretched by less than 2.7"
    );
    assert!(
        1.0 / quantile(mean(&back), 0.5) < 0.56,
        "the median texel of the back is below 0.56 mm"
    );
    assert!(
        quantile(stretch(&back), 0.95) < 2.0,
        "95 % of the back is stretched by less than 2.0"
    );
}

#[test]
fn the_maps_keep_their_budget_and_are_the_same_each_time() {
    let maps = baked();
    let bytes = maps.colour.bytes.len() + maps.normal.bytes.len();
    println!(
        "colour {} normal {}",
        maps.colour.bytes.len(),
        maps.normal.bytes.len()
    );
    assert!(bytes <= 550_000, "{bytes}");
    println!("wrinkles {}", maps.wrinkles.bytes.len());
    assert!(
        maps.wrinkles.bytes.len() <= 120_000,
        "the wrinkle map is within 120000 bytes"
    );
    for image in [&maps.colour, &maps.normal, &maps.wrinkles] {
        assert_eq!(image.mime_type, "image/jpeg");
        assert_eq!(image.bytes[..3], [0xFF, 0xD8, 0xFF]);
    }
    let again = bake(&elder(), &sheets().0, &sheets().1, None);
    assert!(
        again.colour == maps.colour && again.normal == maps.normal,
        "the colour and normal maps are reproducible"
    );
    assert!(
        again.wrinkles == maps.wrinkles,
        "the wrinkle map is reproducible"
    );
}

/// Returns the deepest fold of each kind on the visible skin where `wanted`, mm.
fn deepest(age_years: f64, wanted: impl Fn(DVec3) -> bool) -> [f64; 3] {
    let (head, _) = sheets();
    let skin = SkinParams {
        age_years,
        ..elder()
    };
    let places = head.places.expect("places");
    let marks = ExpressionMarks::new(&skin, places);
    let mut deepest = [0.0f64; 3];
    for t in &head.triangles {
        // Between the corners as well: furrows are narrower than triangles.
        for i in 0..6 {
            for j in 0..6 - i {
                let (x, y) = (f64::from(i) / 5.0, f64::from(j) / 5.0);
                let [q, p, n] = [&head.mean, &head.at, &head.normals].map(|list| {
                    let [a, b, c] = t.map(|v| list[v as usize]);
                    a + (b - a) * x + (c - a) * y
                });
                if wanted(q) {
                    let heights = marks.heights_mm(q, p, n.normalize_or_zero());
                    for (d, h) in deepest.iter_mut().zip(heights) {
                        *d = d.max(-h);
                    }
                }
            }
        }
    }
    deepest
}

#[test]
fn expressive_wrinkles_lie_where_their_muscles_fold_the_skin() {
    let none = |d: f64| d < 0.02;
    let front = |q: DVec3| q.z > 40.0;
    let forehead = deepest(70.0, |q| front(q) && q.y > 52.0 && q.x.abs() < 30.0);
    let brows = deepest(70.0, |q| {
        front(q) && q.x.abs() < 20.0 && (30.0..56.0).contains(&q.y)
    });
    let temple = deepest(70.0, |q| q.x.abs() > 46.0 && (8.0..34.0).contains(&q.y));
    let cheek = deepest(70.0, |q| {
        front(q) && (20.0..50.0).contains(&q.x.abs()) && (-60.0..-20.0).contains(&q.y)
    });
    let lips = deepest(70.0, |q| {
        front(q) && q.x.abs() < 15.0 && (-62.0..-30.0).contains(&q.y)
    });
    let chin = deepest(70.0, |q| {
        front(q) && q.x.abs() < 12.0 && (-88.0..-72.0).contains(&q.y)
    });
    // Nape and crown have no wrinkles.
    let rest = deepest(70.0, |q| q.z < 0.0);
    println!(
        "{forehead:.3?} {brows:.3?} {temple:.3?} {cheek:.3?} {lips:.3?} {chin:.3?} {rest:.3?}"
    );
    assert!(forehead[0] > 0.45 && none(forehead[2]), "{forehead:?}");
    assert!(brows[1] > 0.4, "{brows:?}");
    assert!(temple[1] > 0.25 && none(temple[2]), "{temple:?}");
    assert!(none(cheek[0]) && cheek[1] > 0.45, "{cheek:?}");
    assert!(none(lips[0]) && none(lips[1]) && lips[2] > 0.2, "{lips:?}");
    assert!(chin[2] > 0.15, "{chin:?}");
    assert!(rest.into_iter().all(none), "{rest:?}");
}

#[test]
fn expressive_wrinkles_deepen_with_age() {
    let all = [9.0, 35.0, 70.0].map(|age| deepest(age, |q| q.z > 40.0));
    for kind in 0..3 {
        let [boy, woman, man] = all.map(|d| d[kind]);
        println!("{kind}: {boy:.3} {woman:.3} {man:.3} mm");
        assert!(
            boy > 0.05 && boy < 0.6 * woman && woman < 0.85 * man,
            "{boy} {woman} {man}"
        );
        assert!(man < 1.0, "the map holds a millimetre: {man}");
    }
}
