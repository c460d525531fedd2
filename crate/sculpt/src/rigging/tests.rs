//! A generated head replaces an imported one, so that its rigging can be compared with its own.

use raconteur_body::face::{FaceControls, Jaw, Muscle, Network};

use super::fitted_head::SCAN;
use super::*;
use crate::people;
use crate::tests::soundness::shipped;

/// The skin of a figure's head as a scan in other units and axes, and its landmarks.
fn scanned(name: &str) -> (Scan, Landmarks) {
    let built = &shipped(name).1;
    let names = &built.annotations;
    let mesh = &built.figure.meshes[names.landmark("n").unwrap().mesh];
    // Hands are part of the mesh too.
    let is_head = |v: u32| mesh.positions[v as usize][0].abs() < 0.12;
    let other = |p: [f32; 3]| {
        let p = DVec3::from_array(p.map(f64::from)) * 40.0;
        DVec3::new(p.z + 3.0, p.x - 5.0, p.y)
    };
    let scan = Scan {
        points: mesh.positions.iter().map(|&p| other(p)).collect(),
        colors: Vec::new(),
        faces: mesh
            .indices
            .chunks_exact(3)
            .filter(|t| t.iter().all(|&v| is_head(v)))
            .map(<[u32]>::to_vec)
            .collect(),
    };
    let all = names.landmarks.iter();
    let landmarks = all
        .filter(|l| NEEDED.contains(&l.name.as_str()))
        .map(|l| (l.name.clone(), scan.points[l.vertex as usize]))
        .collect();
    (scan, landmarks)
}

/// Returns the displacement of the rendered skin of a head's mesh under some controls, metres, by
/// vertex.
fn moved(
    figure: &raconteur_body::Figure,
    mesh: &str,
    controls: &FaceControls,
) -> BTreeMap<usize, DVec3> {
    let tissue = figure.tissue.as_ref().unwrap();
    let mut network = Network::new(tissue);
    network.reset(tissue, controls, controls);
    let mut nodes = vec![raconteur_base::NodeState::default(); tissue.rest.len()];
    network.write(tissue, 1.0, &mut nodes);
    let mesh = figure.meshes.iter().find(|m| m.name == mesh).unwrap();
    let binding = mesh.binding.as_ref().unwrap();
    binding
        .apply(&nodes)
        .map(|(v, p, _)| (v, DVec3::from_array(p.map(f64::from))))
        .collect()
}

#[test]
fn another_head_moves_as_if_it_were_ours() {
    let (scan, landmarks) = scanned("kenji");
    let params = people::preset("sofia").unwrap();
    let rigged = rig(&scan, &landmarks, &params).unwrap().figure;
    let own = &shipped("kenji").1.figure;
    let mut smile = FaceControls::default();
    for muscle in [Muscle::ZygomaticusMajorLeft, Muscle::ZygomaticusMajorRight] {
        smile.contraction[muscle.index()] = 0.7;
    }
    let open = FaceControls {
        jaw: Jaw {
            pitch_rad: 0.2,
            ..Jaw::default()
        },
        ..FaceControls::default()
    };
    for (name, controls) in [("smile", smile), ("open", open)] {
        let (want, got) = (
            moved(own, "head", &controls),
            moved(&rigged, SCAN, &controls),
        );
        let (mut error, mut whole, mut count) = (0.0, 0.0, 0.0);
        for (v, d) in &want {
            error += got.get(v).copied().unwrap_or_default().distance_squared(*d);
            whole += d.length_squared();
            count += 1.0;
        }
        assert!(count > 5000.0 && whole > 0.0, "{name}: {count}");
        let share = (error / whole).sqrt();
        assert!(share < 0.3, "{name}: {share} of the movement is wrong");
    }
}

#[test]
fn landmarks_that_are_wrong_are_named() {
    let (scan, landmarks) = scanned("lia");
    let params = people::preset("sofia").unwrap();
    let mut fewer = landmarks.clone();
    fewer.remove("prn");
    let refused = rig(&scan, &fewer, &params).unwrap_err().to_string();
    assert!(refused.contains("prn"), "{refused}");
    let mut swapped = landmarks.clone();
    swapped.insert("ch_l".to_owned(), landmarks["ex_r"]);
    let refused = rig(&scan, &swapped, &params).unwrap_err().to_string();
    assert!(refused.contains("mm from where"), "{refused}");
    assert!(
        matches!(
            rig(&Scan::default(), &landmarks, &params),
            Err(RigError::Empty)
        ),
        "an empty scan is rejected"
    );
}
