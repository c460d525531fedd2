//! Hair, accessories and skin points of a shipped figure.

use std::sync::LazyLock;

use raconteur_base::noise;

use super::*;
use raconteur_body::HairColour;
use raconteur_body::write::to_packed_glb;

const PAPOUS: &[u8] = include_bytes!("../../../../assets/figures/papous.glb");
const LENT: [(&str, &[u8]); 4] = [
    (
        "moustache",
        include_bytes!("../../../../assets/hair/moustache.glb"),
    ),
    (
        "goatee",
        include_bytes!("../../../../assets/hair/goatee.glb"),
    ),
    ("full", include_bytes!("../../../../assets/hair/full.glb")),
    (
        "balding",
        include_bytes!("../../../../assets/hair/balding.glb"),
    ),
];

const WORN: [AccessoryKind; 9] = [
    AccessoryKind::RoundGlasses,
    AccessoryKind::SquareGlasses,
    AccessoryKind::Sunglasses,
    AccessoryKind::EarStuds,
    AccessoryKind::EarRings,
    AccessoryKind::NoseStud,
    AccessoryKind::KnittedCap,
    AccessoryKind::Hat,
    AccessoryKind::Headscarf,
];

fn wear(kind: AccessoryKind) -> Look {
    let colour = [0.3, 0.2, 0.1];
    Look {
        wear: vec![Accessory { kind, colour }],
        ..Look::default()
    }
}

static LENDERS: LazyLock<HairDonors> = LazyLock::new(|| {
    let lender = |(name, glb): (&str, &[u8])| {
        let hair = read_figure(name, glb).expect("hair");
        let lender = HairDonor::new(&hair, VERTICES).expect("our head");
        (name.to_owned(), lender)
    };
    LENT.into_iter().map(lender).collect()
});

fn lent(from: &str) -> Hair {
    Hair {
        from: from.to_owned(),
        colour: None,
    }
}

/// Returns the figure with a look and its own skin, scaled along each axis.
pub(super) fn with(reshaper: &Reshaper, look: &Look, scale: [f64; 3]) -> Figure {
    let scaled = |x: f64, i: usize| x * scale[i % 3];
    let skin: Vec<f64> = own(reshaper)
        .into_iter()
        .enumerate()
        .map(|(i, x)| scaled(x, i))
        .collect();
    let mut organs = organs(reshaper);
    organs.eye_centres = organs.eye_centres.map(|p| p * DVec3::from_array(scale));
    let made = reshaper.with_look(&face(&skin, &[], organs), look, &LENDERS);
    made.expect("a look")
}

fn hair(figure: &Figure) -> Vec<&Mesh> {
    let all = figure.meshes.iter();
    all.filter(|m| m.material.kind == MaterialKind::Hair)
        .collect()
}

fn check(mesh: &Mesh, joints: usize) {
    let count = mesh.positions.len();
    let lists = [mesh.normals.len(), mesh.uvs.len(), mesh.colors.len()];
    assert_eq!(lists, [count; 3], "{}", mesh.name);
    assert_eq!([mesh.joints.len(), mesh.weights.len()], [count; 2]);
    assert!(
        mesh.indices.iter().all(|&v| (v as usize) < count),
        "every index refers to a vertex"
    );
    let is_finite = |p: &[f32; 3]| p.iter().all(|x| x.is_finite());
    assert!(mesh.positions.iter().all(is_finite), "{}", mesh.name);
    let length = |n: &[f32; 3]| wide(*n).length();
    let is_unit = |n: &[f32; 3]| (length(n) - 1.0).abs() < 0.02;
    assert!(mesh.normals.iter().all(is_unit), "{}", mesh.name);
    let is_joint = |j: &u16| usize::from(*j) < joints;
    assert!(mesh.joints.iter().flatten().all(is_joint), "{}", mesh.name);
    assert_eq!(mesh.binding_fault(), None, "{}", mesh.name);
}

#[test]
fn landmarks_are_those_of_the_figures() {
    use super::accessory::landmark::{GNATHION, SELLION, STOMION, SUBAURALE, TRICHION};
    let named = [
        ("sba_l", SUBAURALE[0]),
        ("sba_r", SUBAURALE[1]),
        ("se", SELLION),
        ("tr", TRICHION),
        ("gn", GNATHION),
        ("sto", STOMION),
    ];
    for glb in [SOFIA, PAPOUS] {
        let names = raconteur_body::annotation::annotations(glb).expect("names");
        for (name, vertex) in named {
            let landmark = names.landmark(name).expect(name);
            assert_eq!(
                (landmark.mesh, landmark.vertex as usize),
                (0, vertex),
                "{name}"
            );
        }
    }
}

#[test]
fn lines_of_age_are_kept_in_a_file_and_show_at_rest() {
    let reshaper = sofia();
    let look = Look {
        lines: Some(0.6),
        ..Look::default()
    };
    let old = with(&reshaper, &look, [1.0; 3]);
    let again = read_figure("it", &to_packed_glb(&old, &Default::default())).expect("it");
    for figure in [&old, &again] {
        assert_eq!(figure.tissue.as_ref().expect("tissue").lines, 0.6);
    }
    let own = reshaper.figure.tissue.as_ref().expect("tissue");
    assert_eq!(own.lines, 0.0);
}

#[test]
fn no_look_changes_nothing() {
    let reshaper = sofia();
    let (skin, organs) = (own(&reshaper), organs(&reshaper));
    let plain = reshaper.with_face(&face(&skin, &[], organs)).expect("it");
    let look = with(&reshaper, &Look::default(), [1.0; 3]);
    assert_eq!(plain.meshes, look.meshes);
}

#[test]
fn whatever_is_worn_makes_a_figure_that_is_written_and_read() {
    let reshaper = sofia();
    for (i, kind) in (0..).zip(WORN) {
        // Long, broad and small heads.
        let scale = [0, 1, 2].map(|k| 1.0 + 0.12 * noise::signed(5, k, i));
        let figure = with(&reshaper, &wear(kind), scale);
        let joints = figure.skeleton.joints().len();
        let added = figure.meshes.len() - reshaper.figure.meshes.len();
        assert!((1..=2).contains(&added), "{kind:?}");
        figure.meshes.iter().for_each(|m| check(m, joints));
        let again = read_figure("it", &to_packed_glb(&figure, &Default::default()));
        assert_eq!(again.expect("it").meshes.len(), figure.meshes.len());
    }
}

/// No skin shows through glasses: every part of them is in front of the skin behind it, in frontal
/// view.
#[test]
fn glasses_are_before_the_face() {
    let reshaper = sofia();
    for (i, kind) in (0..6).zip(WORN[..3].iter().cycle()) {
        let scale = [3, 4, 5].map(|k| 1.0 + 0.1 * noise::signed(9, k, i));
        let figure = with(&reshaper, &wear(*kind), scale);
        let skin = &figure.meshes[reshaper.head].positions[..VERTICES];
        let glasses = figure.meshes.iter().find(|m| m.name == "glasses");
        let glasses = glasses.expect("glasses");
        // The bows go to the ears; the rest is before the eyes.
        let front = |p: &&[f32; 3]| f64::from(p[2]) - reshaper.origin.z > 0.075;
        for p in glasses.positions.iter().filter(front) {
            let near = skin
                .iter()
                .filter(|s| (s[0] - p[0]).abs() < 0.002 && (s[1] - p[1]).abs() < 0.002);
            let skin = near.map(|s| s[2]).fold(f32::MIN, f32::max);
            assert!(p[2] > skin - 0.0015, "{kind:?} {p:?} {skin}");
        }
    }
}

#[test]
fn hair_has_the_colour_that_is_asked_for() {
    let reshaper = sofia();
    for (name, colour) in HairColour::NATURAL {
        let mut look = Look::default();
        look.hair.colour = Some(colour);
        let figure = with(&reshaper, &look, [1.0; 3]);
        let wanted = colour.linear_rgb();
        for mesh in hair(&figure) {
            for (i, wanted) in wanted.iter().enumerate() {
                let sum: f64 = mesh.colors.iter().map(|c| f64::from(c[i])).sum();
                let mean = sum / mesh.colors.len() as f64 / 255.0;
                let mean = mean * f64::from(mesh.material.base_color[i]);
                assert!((mean / wanted - 1.0).abs() < 0.12, "{name} {mean} {wanted}");
            }
        }
    }
}

#[test]
fn hair_is_shaved_and_lent() {
    let reshaper = sofia();
    let bald = with(
        &reshaper,
        &Look {
            hair: lent("none"),
            ..Look::default()
        },
        [1.0; 3],
    );
    assert!(hair(&bald).is_empty(), "the bald head has no hair");
    let bearded = |name: &str| {
        let look = Look {
            beard: lent(name),
            ..Look::default()
        };
        with(&reshaper, &look, [1.0; 3])
    };
    let triangles = |figure: &Figure| {
        let beard = hair(figure).into_iter().find(|m| m.name == "beard");
        let beard = beard.expect("a beard");
        check(beard, figure.skeleton.joints().len());
        beard.indices.len() / 3
    };
    let [full, lip, chin] = ["full", "moustache", "goatee"].map(|name| triangles(&bearded(name)));
    assert!(
        lip > 200 && chin > 200 && lip + chin < full,
        "{lip} {chin} {full}"
    );
    let skin = |f: &Figure| f.meshes[reshaper.head].colors[..VERTICES].to_vec();
    assert_ne!(skin(&bearded("full")), skin(&reshaper.figure));
    let stranger = Look {
        hair: lent("nobody"),
        ..Look::default()
    };
    let (own, organs) = (own(&reshaper), organs(&reshaper));
    let made = reshaper.with_look(&face(&own, &[], organs), &stranger, &LENDERS);
    assert!(
        made.expect_err("nobody").to_string().contains("nobody"),
        "the error names the unknown person"
    );
}

/// The scalp is on the head and nowhere in the face, and as light as the hair.
#[test]
fn coloured_hair_has_a_scalp() {
    let reshaper = sofia();
    let figure = &reshaper.figure;
    let [(_, black), .., (_, blond)] = HairColour::NATURAL;
    let [dark, light] = [black, blond].map(|colour| {
        let hair = Hair {
            colour: Some(colour),
            ..Hair::default()
        };
        reshaper.scalp_paint(figure, &hair, &Hair::default())
    });
    assert!(
        dark.corners.len() > 900 && dark.corners.len().is_multiple_of(3),
        "the scalp has more than 900 corners"
    );
    assert_eq!(dark.corners, light.corners);
    assert!(
        5.0 * dark.rgb[0] <= light.rgb[0] && light.rgb[0] <= 1.0,
        "dark hair has a darker scalp than light hair"
    );
    assert!(dark.bare.is_empty(), "dark hair leaves no bare scalp");
    assert_eq!(
        reshaper.scalp_paint(figure, &Hair::default(), &Hair::default()),
        ScalpPaint::default()
    );
    let skin = &figure.meshes[reshaper.head];
    let places = skin.positions[..VERTICES].iter();
    for (p, &is_scalp) in places.zip(reshaper.scalp()) {
        let at = wide(*p) - reshaper.origin;
        let is_face = at.z > 0.07 && at.y < 0.05;
        assert!(!(is_face && is_scalp), "{at}");
    }
}

/// The figure's own hair is painted over, unshaded, where the donor's hair leaves skin bare.
#[test]
fn a_bald_crown_is_skin() {
    let reshaper = sofia();
    let look = Look {
        hair: lent("balding"),
        ..Look::default()
    };
    let figure = with(&reshaper, &look, [1.0; 3]);
    let [crown, none] = ["balding", "bald"]
        .map(|name| reshaper.scalp_paint(&figure, &lent(name), &Hair::default()));
    assert!(
        crown.bare.len() > 300 && crown.corners.len() > 300,
        "the scalp has both bare and haired parts"
    );
    assert!(
        none.bare.len() > crown.bare.len() && none.corners.is_empty(),
        "the bald head is bare everywhere"
    );
    let shade = |f: &Figure| {
        let skin = f.meshes[reshaper.head].colors[..VERTICES].iter();
        skin.map(|c| u64::from(c[3])).sum::<u64>()
    };
    let bald = Look {
        hair: lent("bald"),
        ..Look::default()
    };
    assert!(
        shade(&with(&reshaper, &bald, [1.0; 3])) > shade(&reshaper.figure),
        "the bald head receives more light"
    );
}

/// A new beard removes the painted one of the figure.
#[test]
fn a_painted_beard_is_shaved() {
    let papous = read_figure("papous", PAPOUS).expect("a figure");
    let reshaper = Reshaper::new(papous, VERTICES).expect("our head");
    let paint = |beard: &str| {
        let own = Hair::default();
        reshaper.scalp_paint(&reshaper.figure, &own, &lent(beard))
    };
    assert!(
        paint("none").bare.len() > 300,
        "the shaved beard leaves bare skin"
    );
    assert!(
        paint("own").bare.is_empty(),
        "the own beard leaves no bare skin"
    );
}

/// A moustache grows on the lip of any face, on both halves of it, and none of its roots is inside
/// the skin.
#[test]
fn a_moustache_stands_on_the_lip() {
    let reshaper = sofia();
    let look = Look {
        beard: lent("moustache"),
        ..Look::default()
    };
    for i in 0..4 {
        let scale = [0, 1, 2].map(|k| 1.0 + 0.08 * noise::signed(31, k, i));
        let figure = with(&reshaper, &look, scale);
        let skin = &figure.meshes[reshaper.head];
        let beard = hair(&figure).into_iter().find(|m| m.name == "beard");
        let roots = hairs::roots_of(beard.expect("a beard"));
        let front = |root: &DVec3| {
            let near = skin.positions[..VERTICES].iter().filter(|p| {
                (f64::from(p[0]) - root.x).abs() < 0.0015
                    && (f64::from(p[1]) - root.y).abs() < 0.0015
            });
            near.map(|p| f64::from(p[2])).fold(f64::MIN, f64::max)
        };
        let sunk = roots.iter().filter(|r| r.z < front(r) - 0.002).count();
        assert!(
            20 * sunk < roots.len(),
            "{sunk} of {} are in the skin",
            roots.len()
        );
        let left = roots.iter().filter(|r| r.x > 0.0).count() as f64;
        let share = left / roots.len() as f64;
        // No real lips are equal on both sides.
        assert!((0.3..0.7).contains(&share), "{share}");
    }
}

/// Freckles are on the face, stubble below the nose and off the lips; each seed has its own
/// freckles, age spots and moles.
#[test]
fn spots_lie_where_they_belong() {
    let reshaper = sofia();
    let figure = &reshaper.figure;
    for (kind, least) in [
        (SpeckleKind::Freckles, 200),
        (SpeckleKind::Stubble, 200),
        (SpeckleKind::AgeSpots, 20),
        (SpeckleKind::Moles, 6),
    ] {
        let spots = reshaper.speckles(figure, kind, 1);
        assert!(spots.len() > least, "{kind:?} {}", spots.len());
        let is_own = spots != reshaper.speckles(figure, kind, 2);
        assert_eq!(is_own, kind != SpeckleKind::Stubble, "{kind:?}");
        for spot in &spots {
            assert!(
                (0.0..=1.0).contains(&spot.strength),
                "the strength of the spot is between 0 and 1"
            );
            assert!(
                spot.chart.uv.iter().all(|x| (0.0..=1.0).contains(x)),
                "the texture coordinates of the spot are in the atlas"
            );
        }
    }
}

/// Irises take the requested colour.
#[test]
fn irises_are_recoloured() {
    let reshaper = sofia();
    let look = Look {
        iris: Some([0.1, 0.2, 0.35]),
        ..Look::default()
    };
    let figure = with(&reshaper, &look, [1.0; 3]);
    let eyes = figure
        .meshes
        .iter()
        .filter(|m| m.material.kind == MaterialKind::Eye);
    for eye in eyes {
        let count = eye.colors.len() as f64;
        let mean = |i: usize| {
            let sum: f64 = eye.colors.iter().map(|c| f64::from(c[i])).sum();
            sum / count / 255.0 * f64::from(eye.material.base_color[i])
        };
        assert!(
            (mean(2) - 0.35).abs() < 0.02 && (mean(0) - 0.1).abs() < 0.02,
            "the iris has the requested colour"
        );
    }
}

/// Strands pressed down by a cap lie under it, not through it.
#[test]
fn hair_lies_under_a_cap() {
    let reshaper = sofia();
    for kind in [AccessoryKind::KnittedCap, AccessoryKind::Hat] {
        let figure = with(&reshaper, &wear(kind), [1.0; 3]);
        let cloth = figure
            .meshes
            .iter()
            .find(|m| ["cap", "hat"].contains(&m.name.as_str()));
        let top = |m: &Mesh| m.positions.iter().map(|p| p[1]).fold(f32::MIN, f32::max);
        let own = hair(&figure)[0];
        assert!(top(own) < top(cloth.expect("cloth")) - 0.002, "{kind:?}");
    }
    let scarf = with(&reshaper, &wear(AccessoryKind::Headscarf), [1.0; 3]);
    assert!(
        hair(&scarf).iter().all(|m| m.indices.is_empty()),
        "the scarf hides all hair"
    );
}
