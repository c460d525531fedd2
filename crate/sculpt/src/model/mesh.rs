//! Reader of the base mesh: the subset of Wavefront OBJ used by that file.

use std::path::Path;

use raconteur_base::DVec3;

use super::{ModelError, UNIT_MM};

/// Group of rendered faces; the others are helpers for clothes, joints and eyes.
const BODY: &str = "body";

/// Base mesh of the body model: vertices in millimetres, and the quads of the body.
pub(super) type Mesh = (Vec<DVec3>, Vec<[u32; 4]>);

/// Parses exactly `N` numbers; `None` if there are fewer or if one is invalid.
pub(super) fn numbers<'a, const N: usize>(
    words: impl Iterator<Item = &'a str>,
) -> Option<[f64; N]> {
    let all: Vec<f64> = words
        .take(N)
        .map(str::parse)
        .collect::<Result<_, _>>()
        .ok()?;
    all.try_into().ok()
}

pub(super) fn read(path: &Path, text: &str) -> Result<Mesh, ModelError> {
    let (mut vertices, mut faces, mut group) = (Vec::new(), Vec::new(), "");
    for (i, line) in text.lines().enumerate() {
        let fault = |fault| ModelError::Format {
            path: path.to_owned(),
            line: i + 1,
            fault,
        };
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let p = numbers::<3>(words).ok_or_else(|| fault("expected three numbers"))?;
                vertices.push(DVec3::from_array(p) * UNIT_MM);
            }
            Some("g") => group = words.next().unwrap_or_default(),
            Some("f") if group == BODY => {
                // Vertices count from 1; the number after the slash is the texture's.
                let corner = |word: &str| {
                    let v: u32 = word.split('/').next()?.parse().ok()?;
                    v.checked_sub(1).filter(|v| (*v as usize) < vertices.len())
                };
                let all: Option<Vec<u32>> = words.map(corner).collect();
                let quad = all.and_then(|all| <[u32; 4]>::try_from(all).ok());
                faces.push(quad.ok_or_else(|| fault("expected a quad"))?);
            }
            _ => {}
        }
    }
    Ok((vertices, faces))
}
