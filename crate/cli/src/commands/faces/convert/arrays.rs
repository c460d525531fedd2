//! Models in NumPy arrays, in metres: `mean.npy` (V × 3, or 3V), `modes.npy` (K × V × 3, or K × 3V)
//! and `deviations.npy` (K), of f32 or f64, little endian, in C order; the optional `mesh.obj` has
//! the triangles. Modes need not be orthonormal.

use std::path::Path;

use anyhow::{Context as _, Result, ensure};
use npyz::{DType, Endianness, NpyFile, NpyHeader, Order, TypeChar};
use raconteur_faces::FaceSpace;
use raconteur_voice::files::input;

use super::obj;
use super::{MAX_COORDINATE, MAX_FILE_BYTES, MAX_MODES, MAX_VERTICES, SourceModel};

const MEAN: &str = "mean.npy";
const MODES: &str = "modes.npy";
const DEVIATIONS: &str = "deviations.npy";
/// Names of the arrays; any of them identifies such a folder.
pub(super) const NAMES: [&str; 3] = [MEAN, MODES, DEVIATIONS];
/// Name of the mesh file with the triangles.
const MESH: &str = "mesh.obj";

/// Magic bytes of every NumPy array.
const MAGIC: &[u8] = b"\x93NUMPY";
/// Maximum header length of an array, bytes: NumPy writes 118.
const MAX_HEADER: usize = 512;
/// Maximum number of dimensions of a plain array, and of digits in each.
const MAX_SIZES: usize = 3;
const MAX_DIGITS: usize = 6;

/// Multidimensional NumPy array of numbers; the last dimension varies fastest.
#[derive(Debug)]
pub(super) struct Array {
    pub(super) shape: Vec<usize>,
    pub(super) numbers: Vec<f64>,
}

/// Reads the folder.
pub(super) fn read(folder: &Path) -> Result<SourceModel> {
    let path = |name: &str| folder.join(name);
    let mean = array(&path(MEAN))?;
    let count = mean_vertices(&mean).with_context(|| path(MEAN).display().to_string())?;
    let deviations = array(&path(DEVIATIONS))?;
    check_deviations(&deviations).with_context(|| path(DEVIATIONS).display().to_string())?;
    let modes = array(&path(MODES))?;
    check_modes(&modes, count, deviations.numbers.len())
        .with_context(|| path(MODES).display().to_string())?;
    let rows = modes.numbers.chunks_exact(3 * count);
    let basis: Vec<Vec<f64>> = rows
        .zip(&deviations.numbers)
        .map(|(mode, deviation)| mode.iter().map(|x| x * deviation).collect())
        .collect();
    let mesh = path(MESH);
    let triangles = if mesh.exists() {
        triangles(&mesh, count)?
    } else {
        Vec::new()
    };
    Ok(SourceModel {
        kind: "arrays",
        shape: FaceSpace::of_basis(mean.numbers, &basis)
            .with_context(|| folder.display().to_string())?,
        examples: Vec::new(),
        triangles,
    })
}

/// Reads the triangles of a mesh with this number of vertices; their file position does not matter.
fn triangles(path: &Path, count: usize) -> Result<Vec<[u32; 3]>> {
    let mesh = obj::read(path)?;
    let own = mesh.numbers.len() / 3;
    ensure!(
        own == count,
        "{}: it has {own} vertices, and {MEAN} has {count}",
        path.display()
    );
    Ok(mesh.triangles)
}

/// Returns the number of vertices of a face with this array shape.
fn vertices(shape: &[usize]) -> Option<usize> {
    match shape {
        [count, 3] => Some(*count),
        [numbers] if numbers.is_multiple_of(3) => Some(numbers / 3),
        _ => None,
    }
}

fn mean_vertices(mean: &Array) -> Result<usize> {
    let count = vertices(&mean.shape)
        .with_context(|| format!("its shape is {:?}; expected V × 3 or 3V", mean.shape))?;
    ensure!(
        (1..=MAX_VERTICES).contains(&count),
        "it has {count} vertices, and 1 to {MAX_VERTICES} are read"
    );
    Ok(count)
}

fn check_deviations(deviations: &Array) -> Result<()> {
    let shape = &deviations.shape;
    ensure!(shape.len() == 1, "its shape is {shape:?}; expected K");
    let count = deviations.numbers.len();
    ensure!(
        (1..=MAX_MODES).contains(&count),
        "it has {count} deviations, and 1 to {MAX_MODES} are read"
    );
    ensure!(
        deviations.numbers.iter().all(|d| *d >= 0.0),
        "a standard deviation is negative"
    );
    Ok(())
}

fn check_modes(modes: &Array, count: usize, deviations: usize) -> Result<()> {
    let shape = &modes.shape;
    let wrong = || format!("its shape is {shape:?}; expected K × V × 3 or K × 3V");
    let (own, face) = shape.split_first().with_context(wrong)?;
    let found = vertices(face).with_context(wrong)?;
    ensure!(
        found == count,
        "it has {found} vertices, and {MEAN} has {count}"
    );
    ensure!(
        *own == deviations,
        "it has {own} modes, and {DEVIATIONS} has {deviations}"
    );
    Ok(())
}

fn array(path: &Path) -> Result<Array> {
    let bytes = input::bytes(path, MAX_FILE_BYTES)?;
    parse(&bytes).with_context(|| path.display().to_string())
}

/// Reads an array.
pub(super) fn parse(bytes: &[u8]) -> Result<Array> {
    ensure!(bytes.starts_with(MAGIC), "it is not a NumPy array");
    ensure!(
        header(bytes).is_some_and(is_plain),
        "it is cut off, or its header is not that of a plain array"
    );
    let mut rest = bytes;
    let header = NpyHeader::from_reader(&mut rest).context("its header")?;
    ensure!(
        header.order() == Order::C,
        "it is in Fortran order; expected C order"
    );
    let size = match header.dtype() {
        DType::Plain(kind)
            if kind.type_char() == TypeChar::Float && kind.endianness() == Endianness::Little =>
        {
            kind.size_field()
        }
        _ => 0,
    };
    ensure!(
        size == 4 || size == 8,
        "its numbers are {}, and f32 or f64, little endian, are read",
        header.dtype().descr()
    );
    let wanted = header.len().saturating_mul(size);
    ensure!(
        rest.len() as u64 == wanted,
        "it has {} bytes of numbers; its shape needs {wanted}",
        rest.len()
    );
    let sizes = header.shape().iter().map(|&size| usize::try_from(size));
    let shape: Vec<usize> = sizes.collect::<Result<_, _>>()?;
    let file = NpyFile::with_header(header, rest);
    let numbers: Vec<f64> = if size == 4 {
        file.into_vec::<f32>()?.into_iter().map(f64::from).collect()
    } else {
        file.into_vec()?
    };
    ensure!(
        numbers.iter().all(|x| x.is_finite()),
        "a number is not finite"
    );
    ensure!(
        numbers.iter().all(|x| x.abs() <= MAX_COORDINATE),
        "a number is beyond {MAX_COORDINATE}"
    );
    Ok(Array { shape, numbers })
}

/// Returns the header of an array, a Python expression.
fn header(bytes: &[u8]) -> Option<&[u8]> {
    // After name and version, the length: two bytes in version 1, four in the later ones.
    let (length, at) = match bytes.get(MAGIC.len()..)? {
        [1, _, a, b, ..] => (u32::from(u16::from_le_bytes([*a, *b])), 10_usize),
        [_, _, a, b, c, d, ..] => (u32::from_le_bytes([*a, *b, *c, *d]), 12),
        _ => return None,
    };
    bytes.get(at..)?.get(..length as usize)
}

/// Returns true if an expression is short and flat, with few and small numbers: `npyz` parses
/// nested ones recursively, and multiplies sizes without checks.
fn is_plain(text: &[u8]) -> bool {
    let brackets = text.iter().filter(|b| b"([{".contains(b)).count();
    let words = text.split(|b| !(b.is_ascii_alphanumeric() || *b == b'_'));
    let numbers = words.filter(|word| word.first().is_some_and(u8::is_ascii_digit));
    let lengths: Vec<usize> = numbers.map(<[u8]>::len).collect();
    text.len() <= MAX_HEADER
        && brackets <= 2
        && !text.iter().any(|b| b"+-".contains(b))
        && lengths.len() <= MAX_SIZES
        && lengths.iter().all(|length| *length <= MAX_DIGITS)
}
