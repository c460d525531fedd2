//! Combination rules, and rejection of invalid models.

use super::macros::targets;
use super::*;

fn traits() -> Traits {
    Traits {
        age_years: 35.0,
        sex: 1.0,
        ancestry: Ancestry {
            african: 0.0,
            asian: 1.0,
            european: 3.0,
        },
        muscle: 0.5,
        weight: 0.75,
        height: 0.5,
        proportions: 0.8,
        details: BTreeMap::new(),
    }
}

#[test]
fn anchors_of_a_person_sum_to_one() {
    for age_years in [1.0, 8.0, 10.0, 17.0, 25.0, 35.0, 70.0, 90.0] {
        for sex in [0.0, 0.3, 1.0] {
            let person = Traits {
                age_years,
                sex,
                ..traits()
            };
            let sum = |start: &str| -> f64 {
                let named = targets(&person);
                let of_kind = named.iter().filter(|(name, _)| name.starts_with(start));
                of_kind.map(|(_, w)| w).sum()
            };
            for kind in ["macrodetails/universal", "macrodetails/caucasian"] {
                let whole = if kind.ends_with("universal") {
                    1.0
                } else {
                    0.75
                };
                assert!(
                    (sum(kind) - whole).abs() < 1e-12,
                    "{kind} {age_years} {sex}"
                );
            }
            assert_eq!(sum("macrodetails/height"), 0.0);
        }
    }
}

#[test]
fn a_woman_of_thirty_five_is_mostly_young() {
    let all = targets(&traits());
    let old = all["macrodetails/caucasian-female-old"];
    // (35 − 25) / 130 of a distance of 0.5.
    assert!((old - 0.75 * 10.0 / 65.0).abs() < 1e-12, "{old}");
    assert!(
        !all.keys()
            .any(|name| name.contains("-male-") || name.contains("baby")),
        "no shape of a baby or man takes part"
    );
}

#[test]
fn a_folder_without_a_model_says_what_fetches_it() {
    let error = Model::open(Path::new("nowhere")).unwrap_err().to_string();
    assert!(
        error.contains("base.obj") && error.contains("npm run model"),
        "{error}"
    );
}

#[test]
fn another_mesh_is_no_model() {
    let folder = std::env::temp_dir().join(format!("raconteur-no-model-{}", std::process::id()));
    std::fs::create_dir_all(folder.join("3dobjs")).unwrap();
    std::fs::write(
        folder.join("3dobjs/base.obj"),
        "v 0 0 0\ng body\nf 1 1 1 1\n",
    )
    .unwrap();
    let error = Model::open(&folder).unwrap_err().to_string();
    std::fs::remove_dir_all(&folder).unwrap();
    assert!(error.contains("hm08"), "{error}");
}

#[test]
fn faults_of_the_mesh_name_their_line() {
    let path = Path::new("base.obj");
    for (text, line) in [
        ("v 0 0\n", 1),
        ("v 0 0 0\ng body\nf 1/1 1/1 1/1\n", 3),
        ("v 0 0 0\ng body\nf 1/1 1/1 1/1 2/2\n", 3),
        ("v 0 0 0\ng body\nf 0 1 1 1\n", 3),
    ] {
        let error = mesh::read(path, text).unwrap_err().to_string();
        assert!(
            error.contains(&format!("line {line}:")),
            "{text:?}: {error}"
        );
    }
    let (vertices, faces) = mesh::read(path, "v 1 2 3\ng body\nf 1/9 1/9 1 1\n").unwrap();
    assert_eq!(vertices, [DVec3::new(100.0, 200.0, 300.0)]);
    assert_eq!(faces, [[0; 4]]);
}
