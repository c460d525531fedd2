//! Springs in glTF: the extension `VRMC_springBone` 1.0.
//!
//! <https://github.com/vrm-c/vrm-specification/tree/master/specification/VRMC_springBone-1.0>

use raconteur_base::DVec3;
use serde_json::{Value, json};

use super::fields::{index, indices, items, numbers};
use crate::springs::{Chain, Collider, SpringLink, Springs, place};

/// The extension's name.
pub(super) const EXTENSION: &str = "VRMC_springBone";
/// Maximum number of spring joints in a file; more are left out.
const MAX_JOINTS: usize = 128;
const MAX_COLLIDERS: usize = 128;

/// Reads the springs of a document, whose joints are node numbers. A node belongs to one chain
/// only: a chain that would share one, or that has an invalid number, is left out.
pub(super) fn read(root: &Value) -> Springs {
    let of = &root["extensions"][EXTENSION];
    let read: Vec<Option<Collider>> = items(of, "colliders")
        .iter()
        .take(MAX_COLLIDERS)
        .map(collider)
        .collect();
    let groups = items(of, "colliderGroups");
    let mut taken = Vec::new();
    let mut chains = Vec::new();
    for spring in items(of, "springs") {
        let links: Option<Vec<SpringLink>> = items(spring, "joints").iter().map(link).collect();
        let Some(links) = links.filter(|l| l.len() > 1) else {
            continue;
        };
        let nodes: Vec<usize> = links.iter().map(|l| l.joint).collect();
        let is_new = |i: usize| !taken.contains(&nodes[i]) && !nodes[..i].contains(&nodes[i]);
        if taken.len() + nodes.len() > MAX_JOINTS || !(0..nodes.len()).all(is_new) {
            continue;
        }
        taken.extend(nodes);
        let mut colliders: Vec<usize> = indices(spring, "colliderGroups")
            .iter()
            .filter_map(|g| groups.get(*g))
            .flat_map(|g| indices(g, "colliders"))
            .filter_map(|c| place(&read, c))
            .collect();
        colliders.sort_unstable();
        colliders.dedup();
        chains.push(Chain { links, colliders });
    }
    Springs {
        chains,
        colliders: read.into_iter().flatten().collect(),
    }
}

fn number(value: &Value, key: &str, absent: f64) -> Option<f64> {
    let x = value[key].as_f64().unwrap_or(absent);
    x.is_finite().then_some(x)
}

fn vector(value: &Value, key: &str, absent: DVec3) -> Option<DVec3> {
    let v = numbers(value, key).map_or(absent, DVec3::from_array);
    v.is_finite().then_some(v)
}

fn link(value: &Value) -> Option<SpringLink> {
    let direction = vector(value, "gravityDir", DVec3::NEG_Y)?;
    Some(SpringLink {
        joint: index(value, "node")?,
        stiffness: number(value, "stiffness", 1.0)?.clamp(0.0, 10.0),
        gravity: direction.clamp_length_max(1.0)
            * number(value, "gravityPower", 0.0)?.clamp(-10.0, 10.0),
        drag: number(value, "dragForce", 0.5)?.clamp(0.0, 1.0),
        radius_m: number(value, "hitRadius", 0.0)?.clamp(0.0, 1.0),
    })
}

fn collider(value: &Value) -> Option<Collider> {
    let shape = &value["shape"];
    let (of, has_tail) = if shape["capsule"].is_object() {
        (&shape["capsule"], true)
    } else {
        (&shape["sphere"], false)
    };
    let offset = vector(of, "offset", DVec3::ZERO)?;
    let tail = if has_tail {
        vector(of, "tail", DVec3::ZERO)?
    } else {
        offset
    };
    Some(Collider {
        joint: index(value, "node")?,
        ends: [offset, tail],
        radius_m: number(of, "radius", 0.0)?.clamp(0.0, 10.0),
    })
}

/// Returns the JSON of the `VRMC_springBone` extension for a file whose nodes are the joints.
pub(super) fn write(springs: &Springs, numbers: &dyn Fn(&[f64]) -> Value) -> Value {
    let one = |x: f64| numbers(&[x])[0].clone();
    let colliders: Vec<Value> = springs
        .colliders
        .iter()
        .map(|c| {
            let [offset, tail] = c.ends.map(|e| numbers(&e.to_array()));
            let radius = one(c.radius_m);
            let shape = if c.ends[0] == c.ends[1] {
                json!({ "sphere": { "offset": offset, "radius": radius } })
            } else {
                json!({ "capsule": { "offset": offset, "radius": radius, "tail": tail } })
            };
            json!({ "node": c.joint, "shape": shape })
        })
        .collect();
    let mut groups: Vec<&[usize]> = Vec::new();
    let chains: Vec<Value> = springs
        .chains
        .iter()
        .map(|chain| {
            let joints: Vec<Value> = chain
                .links
                .iter()
                .map(|l| {
                    let power = l.gravity.length();
                    let direction = l.gravity.normalize_or(DVec3::NEG_Y).to_array();
                    json!({
                        "node": l.joint,
                        "hitRadius": one(l.radius_m),
                        "stiffness": one(l.stiffness),
                        "gravityPower": one(power),
                        "gravityDir": numbers(&direction),
                        "dragForce": one(l.drag),
                    })
                })
                .collect();
            let mut value = json!({ "joints": joints });
            if !chain.colliders.is_empty() {
                let known = groups.iter().position(|g| **g == chain.colliders[..]);
                let group = known.unwrap_or_else(|| {
                    groups.push(&chain.colliders);
                    groups.len() - 1
                });
                value["colliderGroups"] = json!([group]);
            }
            value
        })
        .collect();
    let mut value = json!({ "specVersion": "1.0", "springs": chains });
    // glTF allows no empty lists.
    if !colliders.is_empty() {
        value["colliders"] = json!(colliders);
    }
    if !groups.is_empty() {
        value["colliderGroups"] = groups.iter().map(|g| json!({ "colliders": g })).collect();
    }
    value
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Returns a chain of four links that collides with two colliders, a sphere and a capsule.
    fn springs() -> Springs {
        let link = |joint| SpringLink {
            joint,
            stiffness: 0.35,
            gravity: DVec3::NEG_Y * 0.12,
            drag: 0.45,
            radius_m: 0.004,
        };
        let collider = |joint, ends, radius_m| Collider {
            joint,
            ends,
            radius_m,
        };
        Springs {
            chains: vec![Chain {
                links: (60..64).map(link).collect(),
                colliders: vec![0, 1],
            }],
            colliders: vec![
                collider(4, [DVec3::ZERO; 2], 0.07),
                collider(3, [DVec3::ZERO, DVec3::X * 0.08], 0.05),
            ],
        }
    }

    fn numbers(xs: &[f64]) -> Value {
        json!(xs)
    }

    #[test]
    fn files_keep_springs() {
        let springs = springs();
        let root = json!({ "extensions": { EXTENSION: write(&springs, &numbers) } });
        let read = read(&root);
        assert_eq!(read.colliders, springs.colliders);
        for (a, b) in read.chains[0].links.iter().zip(&springs.chains[0].links) {
            assert!(
                a.gravity.distance(b.gravity) < 1e-12,
                "the gravity of the spring round trips"
            );
            assert_eq!(
                (a.joint, a.stiffness, a.drag, a.radius_m),
                (b.joint, b.stiffness, b.drag, b.radius_m)
            );
        }
        assert_eq!(read.chains[0].colliders, [0, 1]);
    }

    #[test]
    fn hostile_springs_are_left_out() {
        let of = |springs: Value| read(&json!({ "extensions": { EXTENSION: springs } }));
        let joints =
            |nodes: &[i64]| -> Value { nodes.iter().map(|n| json!({ "node": n })).collect() };
        for bad in [
            json!(null),
            json!(7),
            json!({ "springs": "x", "colliders": {} }),
            json!({ "springs": [{ "joints": joints(&[1]) }] }),
            json!({ "springs": [{ "joints": joints(&[1, 1]) }] }),
            json!({ "springs": [{ "joints": joints(&[1, -2]) }] }),
            json!({ "springs": [{ "joints": joints(&(0..500).collect::<Vec<_>>()) }] }),
            json!({ "springs": [{ "joints": [{ "node": 1, "gravityDir": [1e308, 1e308, "x"] }, 4] }] }),
        ] {
            assert!(of(bad.clone()).is_empty(), "{bad}");
        }
        let shared = of(json!({ "springs": [
            { "joints": joints(&[1, 2]), "colliderGroups": [0, 9, -1] },
            { "joints": joints(&[2, 3]) },
        ], "colliderGroups": [{ "colliders": [5, 0, 0] }], "colliders": [{ "node": 4 }] }));
        assert_eq!(shared.chains.len(), 1);
        assert_eq!(shared.chains[0].colliders, [0]);
        let wild = of(json!({ "springs": [{ "joints": [
            { "node": 1, "stiffness": 1e300, "dragForce": -4, "gravityPower": 1e300 }, { "node": 2 }
        ] }] }));
        let link = wild.chains[0].links[0];
        assert!(
            link.stiffness <= 10.0 && link.drag == 0.0 && link.gravity.length() <= 10.0,
            "hostile spring values are clamped"
        );
    }
}
