use std::fmt::Write as _;

use proptest::prelude::*;
use tempfile::TempDir;

use super::*;

/// A square in centimetres, and two faces that differ from it.
const SQUARE: [[f64; 3]; 4] = [
    [0.0, 0.0, 1.0],
    [10.0, 0.0, 0.0],
    [10.0, 10.0, 0.0],
    [0.0, 10.0, 0.0],
];
const QUAD: &str = "f 1/1/1 2/1/1 3//1 4\n";

fn square_and(vertex: usize, by: [f64; 3]) -> Vec<[f64; 3]> {
    let mut points = SQUARE.to_vec();
    for (x, by) in points[vertex].iter_mut().zip(by) {
        *x += by;
    }
    points
}

fn obj(points: &[[f64; 3]], faces: &str) -> String {
    let mut text = String::from("mtllib none.mtl\n");
    for [x, y, z] in points {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    text + "g part\nusemtl skin\nvt 0 0\nvn 0 0 1\n" + faces
}

fn npy(descr: &str, shape: &str, data: &[u8]) -> Vec<u8> {
    let order = if descr.ends_with("4F") {
        "True"
    } else {
        "False"
    };
    let descr = descr.trim_end_matches('F');
    let header =
        format!("{{'descr': '{descr}', 'fortran_order': {order}, 'shape': {shape}, }}   \n");
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(data);
    bytes
}

fn doubles(numbers: &[f64]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

fn singles(numbers: &[f64]) -> Vec<u8> {
    let singles = numbers.iter().map(|&x| x as f32);
    singles.flat_map(f32::to_le_bytes).collect()
}

fn folder(files: &[(&str, Vec<u8>)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).unwrap();
    }
    folder
}

fn ict() -> Vec<(&'static str, Vec<u8>)> {
    let file = |points: &[[f64; 3]]| obj(points, QUAD).into_bytes();
    vec![
        ("generic_neutral_mesh.obj", file(&SQUARE)),
        ("identity000.obj", file(&square_and(0, [3.0, 0.0, 0.0]))),
        ("identity001.obj", file(&square_and(2, [0.0, 0.0, 4.0]))),
        ("jawOpen.obj", file(&square_and(1, [0.0, 9.0, 0.0]))),
    ]
}

/// Two modes of two vertices that are not orthogonal, the mesh's triangle.
fn arrays() -> Vec<(&'static str, Vec<u8>)> {
    let mean: Vec<f64> = SQUARE.iter().flatten().map(|x| 0.01 * x).collect();
    let mut modes = vec![0.0; 24];
    modes[0] = 1.0;
    modes[12] = 1.0;
    modes[13] = 1.0;
    vec![
        ("mean.npy", npy("<f8", "(4, 3)", &doubles(&mean))),
        ("modes.npy", npy("<f4", "(2, 12)", &singles(&modes))),
        (
            "deviations.npy",
            npy("<f8", "(2,)", &doubles(&[0.25, 0.125])),
        ),
        ("mesh.obj", obj(&SQUARE, "f 1 2 3\n").into_bytes()),
    ]
}

fn meshes() -> Vec<(&'static str, Vec<u8>)> {
    let file = |points: &[[f64; 3]]| obj(points, QUAD).into_bytes();
    vec![
        ("a.obj", file(&SQUARE)),
        ("b.OBJ", file(&square_and(0, [3.0, 0.0, 0.0]))),
        ("c.obj", file(&square_and(2, [0.0, 0.0, 1.0]))),
        ("readme.txt", b"no mesh".to_vec()),
    ]
}

fn made(files: &[(&str, Vec<u8>)], modes: usize) -> (FaceModel, f64) {
    let folder = folder(files);
    let found = read(folder.path()).unwrap();
    found.model(NonZeroUsize::new(modes)).unwrap()
}

/// Returns the message for a folder in which one file is replaced by another, or removed if empty.
fn told(mut files: Vec<(&'static str, Vec<u8>)>, name: &'static str, bytes: Vec<u8>) -> String {
    files.retain(|(other, _)| *other != name);
    if !bytes.is_empty() {
        files.push((name, bytes));
    }
    let folder = folder(&files);
    format!("{:#}", read(folder.path()).unwrap_err())
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    let squares = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b));
    squares.sum::<f64>().sqrt()
}

#[test]
fn the_components_of_ict_facekit_become_modes_in_metres() {
    let (model, explained) = made(&ict(), 0);
    assert!(
        (explained - 1.0).abs() < 1e-12,
        "the modes explain the whole variance"
    );
    assert!(
        distance(model.shape.deviations(), &[0.04, 0.03]) < 1e-12,
        "the deviations are in metres"
    );
    assert_eq!(model.triangles, [[0, 1, 2], [0, 2, 3]]);
    let mut face: Vec<f64> = SQUARE.iter().flatten().map(|x| 0.01 * x).collect();
    assert!(
        distance(model.shape.mean(), &face) < 1e-12,
        "the mean face is in metres"
    );
    face[0] += 2.0 * 0.03;
    face[8] -= 0.04;
    let own = model.shape.coefficients(&face).unwrap();
    assert!(
        distance(&model.shape.face(&own), &face) < 1e-12,
        "the face of the coefficients is in metres"
    );

    let (least, explained) = made(&ict(), 1);
    assert_eq!(least.shape.dimensions(), 1);
    assert!(
        (explained - 0.64).abs() < 1e-12,
        "one mode explains 64 % of the variance"
    );
}

#[test]
fn modes_of_arrays_are_made_orthonormal() {
    let (model, _) = made(&arrays(), 9);
    assert_eq!((model.shape.dimensions(), model.triangles.len()), (2, 1));
    // The variances of the basis add up for any directions.
    let variance: f64 = model.shape.deviations().iter().map(|d| d * d).sum();
    assert!(
        (variance - (0.0625 + 2.0 * 0.015_625)).abs() < 1e-9,
        "the variance of the modes"
    );
    let across: f64 = (0..12)
        .map(|i| model.shape.mode(0)[i] * model.shape.mode(1)[i])
        .sum();
    assert!(across.abs() < 1e-9, "the modes are orthogonal");

    // The same without triangles, and in the other shapes.
    let mut others = arrays();
    others.pop();
    others[0].1 = npy("<f4", "(12,)", &singles(model.shape.mean()));
    let file = &mut others[1].1;
    let data = file.split_off(file.len() - 96);
    *file = npy("<f4", "(2, 4, 3)", &data);
    let (other, _) = made(&others, 9);
    assert!(
        other.triangles.is_empty(),
        "the second model has no triangles"
    );
    assert!(
        distance(other.shape.deviations(), model.shape.deviations()) < 1e-12,
        "both models have the same deviations"
    );
}

#[test]
fn meshes_alone_are_examples() {
    let (model, explained) = made(&meshes(), 9);
    assert!(
        (explained - 1.0).abs() < 1e-12,
        "the modes explain the whole variance of the examples"
    );
    assert_eq!((model.shape.dimensions(), model.examples.len()), (2, 3));
    let second: Vec<f64> = square_and(0, [3.0, 0.0, 0.0]).concat();
    assert!(
        distance(&model.shape.face(&model.examples[1]), &second) < 1e-9,
        "the second example is restored"
    );
}

#[test]
fn a_pack_of_every_kind_is_read_again() {
    for files in [ict(), arrays(), meshes()] {
        let folder = folder(&files);
        let output = folder.path().join("pack");
        let convert = Convert {
            folder: folder.path().to_owned(),
            output: output.clone(),
            modes: NonZeroUsize::new(1),
        };
        convert.run().unwrap();
        let model = FaceModel::from_bytes(&fs::read(output).unwrap()).unwrap();
        assert_eq!((model.shape.length(), model.shape.dimensions()), (12, 1));
        assert!(
            model.cage.evaluate(&[1.0]).is_empty(),
            "the pack has no cage"
        );
        assert!(
            model.segments.all().is_empty() && model.attributes.is_empty(),
            "the pack has neither segments nor attributes"
        );
    }
}

#[test]
fn broken_folders_of_meshes_are_told_by_name() {
    let three = obj(&SQUARE[..3], "f 1 2 3\n").into_bytes();
    let cases = [
        ("identity001.obj", three.clone(), "it has 3 vertices"),
        ("identity000.obj", vec![], "identity000.obj is missing"),
        (
            "generic_neutral_mesh.obj",
            vec![],
            "generic_neutral_mesh.obj",
        ),
        ("identity000.obj", b"v 1 2 nan\n".to_vec(), "line 1"),
        ("identity000.obj", b"# x\n".to_vec(), "it has no vertices"),
        ("identity000.obj", b"v 1 2 3e9\n".to_vec(), "beyond 1000000"),
        (
            "identity000.obj",
            obj(&SQUARE, "f 1 2 3\nf 1 2 9\n").into_bytes(),
            "1 of its 2 faces",
        ),
        (
            "identity000.obj",
            "v 0 0 0\n".repeat(MAX_VERTICES + 1).into_bytes(),
            "200001 vertices",
        ),
        ("identity000.obj", b"v \xff\n".to_vec(), "0xff"),
    ];
    for (name, bytes, why) in cases {
        let told = told(ict(), name, bytes);
        assert!(told.contains(name) && told.contains(why), "{told}");
    }
    let told = told(meshes(), "c.obj", three);
    assert!(told.contains("c.obj: it has 3 vertices, and "), "{told}");
}

#[test]
fn folders_without_a_model_are_told_by_name() {
    let empty = tempfile::tempdir().unwrap();
    let said = |path: &Path| format!("{:#}", read(path).unwrap_err());
    assert!(
        said(empty.path()).contains("it contains no model"),
        "the error for a folder without a model"
    );
    assert!(
        said(&empty.path().join("none")).contains("cannot read"),
        "the error for an unreadable folder"
    );
    let one = folder(&meshes()[..1]);
    assert!(
        said(one.path()).contains("at least two examples"),
        "the error for a single example"
    );
    let file = obj(&SQUARE, QUAD).into_bytes();
    let same = folder(&[("a.obj", file.clone()), ("b.obj", file)]);
    assert!(
        said(same.path()).contains("its faces do not differ"),
        "the error for identical faces"
    );
}

#[test]
fn broken_arrays_are_told_by_name() {
    let twelve = [0.5; 12];
    let cases = [
        ("mean.npy", vec![], "cannot read"),
        ("mean.npy", b"mean".to_vec(), "not a NumPy array"),
        ("mean.npy", b"\x93NUMPY\x01\x00".to_vec(), "cut off"),
        (
            "mean.npy",
            npy("<f8", "(4, 3)", &doubles(&twelve[..11])),
            "88 bytes",
        ),
        ("mean.npy", npy("<f8", "(2, 6)", &doubles(&twelve)), "V × 3"),
        ("mean.npy", npy("<f8", "(0, 3)", &[]), "0 vertices"),
        ("mean.npy", npy(">f8", "(4, 3)", &doubles(&twelve)), ">f8"),
        ("mean.npy", npy("<i8", "(4, 3)", &doubles(&twelve)), "<i8"),
        (
            "mean.npy",
            npy("<f4F", "(4, 3)", &singles(&twelve)),
            "Fortran",
        ),
        (
            "mean.npy",
            npy("<f8", "(3,)", &doubles(&[0.0, 1.0, f64::NAN])),
            "not finite",
        ),
        (
            "mean.npy",
            npy("<f8", "(3,)", &doubles(&[0.0, 1.0, 1e7])),
            "beyond 1000000",
        ),
        (
            "mean.npy",
            npy("<f8", "(9999999, 9999999, 9999999)", &[]),
            "plain array",
        ),
        (
            "mean.npy",
            npy("<f8", &"(".repeat(9000), &[]),
            "plain array",
        ),
        (
            "mean.npy",
            npy("<f8", "(3,)", &doubles(&[0.0; 3])),
            "modes.npy: it has 4 vertices",
        ),
        (
            "modes.npy",
            npy("<f8", "(1, 12)", &doubles(&twelve)),
            "it has 1 modes",
        ),
        ("modes.npy", npy("<f8", "()", &doubles(&[1.0])), "K × V × 3"),
        ("modes.npy", vec![], "cannot read"),
        (
            "deviations.npy",
            npy("<f8", "(2,)", &doubles(&[1.0, -1.0])),
            "negative",
        ),
        (
            "deviations.npy",
            npy("<f8", "(1, 2)", &doubles(&[1.0, 1.0])),
            "expected K",
        ),
        (
            "deviations.npy",
            npy("<f8", "(401,)", &doubles(&[1.0; 401])),
            "401 deviations",
        ),
        (
            "mesh.obj",
            b"v 0 0 0\n".to_vec(),
            "it has 1 vertices, and mean.npy has 4",
        ),
    ];
    for (name, bytes, why) in cases {
        let told = told(arrays(), name, bytes);
        assert!(told.contains(name) && told.contains(why), "{why}: {told}");
    }
    let still = npy("<f8", "(2,)", &doubles(&[0.0, 0.0]));
    let told = told(arrays(), "deviations.npy", still);
    assert!(told.contains("its faces do not differ"), "{told}");
}

#[test]
fn a_pack_that_would_be_too_large_is_not_made() {
    let (model, _) = made(&ict(), 0);
    let bytes = pack(&model, MAX_BYTES).unwrap();
    assert!(
        pack(&model, bytes.len()).is_ok(),
        "a pack at its size limit is written"
    );
    let told = pack(&model, bytes.len() - 1).unwrap_err().to_string();
    assert!(told.contains("`--modes` keeps fewer"), "{told}");
}

proptest! {
    #[test]
    fn no_change_of_an_array_panics(at in 0..160_usize, byte: u8, cut in 0..160_usize) {
        let mut bytes = npy("<f8", "(4, 3)", &doubles(&[0.5; 12]));
        let at = at % bytes.len();
        bytes[at] = byte;
        let _ = arrays::parse(&bytes);
        bytes.truncate(cut);
        let _ = arrays::parse(&bytes);
    }
}
