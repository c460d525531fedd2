//! Projection of the template's points onto the field, with outward winding of its faces.

use std::collections::BTreeMap;

use raconteur_base::{DVec3, mirror_vector};

use super::Key;
use crate::subdivide::edge_faces;
use crate::torso::field::{Field, Regions};
use crate::torso::shape::CM;
use crate::torso::shell::Shell;

/// Wraps the cage onto the body in forty rounds of sliding and projecting; the right side mirrors
/// the left.
pub(super) fn wrap(shell: &mut Shell, keys: &[Key], index: &BTreeMap<Key, u32>, field: &Field) {
    let (around, _) = shell.neighbours();
    let mut normals = vec![DVec3::ZERO; keys.len()];
    for round in 0..40 {
        if round > 1 {
            let before = shell.points.clone();
            for (v, key) in keys.iter().enumerate() {
                if key.slides() && !key.is_right() {
                    let mean: DVec3 = around[v].iter().map(|&i| before[i as usize]).sum::<DVec3>()
                        / around[v].len().max(1) as f64;
                    let d = mean - before[v];
                    shell.points[v] += (d - normals[v] * d.dot(normals[v])) * 0.35;
                }
            }
        }
        for (v, key) in keys.iter().enumerate() {
            if key.is_right() {
                continue;
            }
            let p = &mut shell.points[v];
            let (d, n) = field.value_and_normal(*p, key.regions(), 1.0);
            *p -= n * d.clamp(-2.5 * CM, 2.5 * CM) * 0.8;
            normals[v] = n;
            if key.is_midline() {
                p.x = 0.0;
            } else if matches!(key, Key::Leg(..)) {
                p.x = p.x.max(0.2 * CM);
            }
        }
        for (v, key) in keys.iter().enumerate() {
            if key.is_right() {
                shell.points[v] = mirror_vector(shell.points[index[&key.mirrored()] as usize]);
            }
        }
    }
}

/// Orients the faces outwards. Neighbours traverse their shared edge in opposite directions, so a
/// face folded at a crease of the field still agrees with those around it; the field's gradient
/// over all faces determines the outward side.
pub(super) fn wind(shell: &mut Shell, field: &Field) {
    let edges = edge_faces(&shell.faces);
    let runs = |face: &[u32], a: u32, b: u32| {
        (0..face.len()).any(|i| face[i] == a && face[(i + 1) % face.len()] == b)
    };
    let mut wound = vec![false; shell.faces.len()];
    for start in 0..shell.faces.len() {
        if wound[start] {
            continue;
        }
        wound[start] = true;
        let (mut piece, mut next) = (vec![start], 0);
        while let Some(&f) = piece.get(next) {
            next += 1;
            let face = shell.faces[f].clone();
            for i in 0..face.len() {
                let (a, b) = (face[i], face[(i + 1) % face.len()]);
                for &g in &edges[&(a.min(b), a.max(b))] {
                    let g = g as usize;
                    if wound[g] {
                        continue;
                    }
                    if runs(&shell.faces[g], a, b) {
                        shell.faces[g].reverse();
                    }
                    wound[g] = true;
                    piece.push(g);
                }
            }
        }
        let out: f64 = piece
            .iter()
            .map(|&f| outward(&shell.points, &shell.faces[f], field))
            .sum();
        if out < 0.0 {
            piece.iter().for_each(|&f| shell.faces[f].reverse());
        }
    }
}

/// Returns twice the area with which a quad faces out of the field, square metres; negative if it
/// faces inwards.
fn outward(points: &[DVec3], face: &[u32], field: &Field) -> f64 {
    let p = |i: usize| points[face[i] as usize];
    let area = (p(2) - p(0)).cross(p(3) - p(1));
    let centre = (p(0) + p(1) + p(2) + p(3)) / 4.0;
    let regions = if centre.y < 0.49 * field.stature_m {
        Regions::LOWER
    } else {
        Regions::UPPER
    };
    area.dot(field.value_and_normal(centre, regions, 1.0).1)
}
