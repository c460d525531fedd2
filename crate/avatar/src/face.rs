//! Face channels from the morph targets of a figure.
//!
//! The actor moves targets with ARKit names. A figure with those targets uses them directly. For
//! one with visemes (Oculus' fifteen) or VRM's vowels, the same channels are sums of its targets,
//! so that later stages need no special case.

mod recipes;

use std::collections::BTreeMap;

use serde_json::Value;

pub(crate) use self::recipes::Region;
use self::recipes::{OVER_JAW, RECIPES, Sum, recognise, recognise_expression};
use super::error::DiagnosticSink;
use raconteur_body::read::document::Document;

/// Morph target of a mesh in the imported file, with its weight in a sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct WeightedTarget {
    pub(super) mesh: usize,
    pub(super) target: usize,
    pub(super) factor: f64,
}

/// Morph target of the resulting figure, as a weighted sum of targets of the imported file.
pub(super) struct Channel {
    pub(super) name: &'static str,
    pub(super) parts: Vec<WeightedTarget>,
    pub(super) region: Region,
}

/// Face of an imported file: its morph targets mapped to the figure's, and the targets that move
/// mouth and lids.
pub(super) struct ImportedFace {
    pub(super) channels: Vec<Channel>,
    /// Targets that speech moves, and those that close the lids.
    pub(super) mouth: Vec<WeightedTarget>,
    pub(super) lids: Vec<WeightedTarget>,
    /// True if targets open the mouth; otherwise a jaw bone may.
    pub(super) opens_by_morph: bool,
}

type Sources = BTreeMap<&'static str, Vec<WeightedTarget>>;

impl ImportedFace {
    /// Finds the face; `has_jaw` and `has_eyes` indicate bones.
    pub(super) fn find(
        json: &Value,
        root: &Document<'_>,
        has_jaw: bool,
        has_eyes: bool,
        notes: &mut DiagnosticSink,
    ) -> Self {
        let mut sources = expressions(json, root);
        let mut by_name = Sources::new();
        for (mesh, m) in root.meshes.iter().enumerate() {
            // Some exporters name the targets at the first primitive.
            let other = &json["meshes"][mesh]["primitives"][0]["extras"]["targetNames"];
            let other = other.as_array().map_or(&[][..], Vec::as_slice);
            let names = m.target_names.iter().map(String::as_str);
            let others = other.iter().map(|n| n.as_str().unwrap_or_default());
            for (target, name) in names.chain(others.skip(m.target_names.len())).enumerate() {
                if let Some(key) = recognise(name) {
                    by_name.entry(key).or_default().push(WeightedTarget {
                        mesh,
                        target,
                        factor: 1.0,
                    });
                }
            }
        }
        for (key, parts) in by_name {
            sources.entry(key).or_insert(parts);
        }
        let mut channels = Vec::new();
        for (name, sums, region) in RECIPES.into_iter() {
            // Bones turn the eyes better than targets do.
            if has_eyes && name.starts_with("eyeLook") {
                continue;
            }
            channels.extend(channel(&sources, name, sums, region));
        }
        let parts_of = |keys: &[&str]| -> Vec<WeightedTarget> {
            keys.iter()
                .filter_map(|k| sources.get(k))
                .flatten()
                .copied()
                .collect()
        };
        let has = |name: &str| channels.iter().any(|c| c.name == name);
        let face = Self {
            opens_by_morph: has("jawOpen"),
            mouth: parts_of(&[
                "jawOpen",
                "aa",
                "E",
                "I",
                "O",
                "U",
                "mouthOpen",
                "mouthSmile",
            ]),
            lids: parts_of(&["eyeBlinkLeft", "eyeBlinkRight", "blink"]),
            channels,
        };
        face.report(&sources, has_jaw, has_eyes, notes);
        face
    }

    fn report(&self, sources: &Sources, has_jaw: bool, has_eyes: bool, notes: &mut DiagnosticSink) {
        let has = |name: &str| self.channels.iter().any(|c| c.name == name);
        if !self.opens_by_morph {
            let hint = "add ARKit's or Oculus' morph targets, or VRM expressions";
            if has_jaw {
                notes.add(
                    "mouth-by-jaw",
                    "speech opens the jaw only; the lips do not move",
                    hint,
                );
            } else {
                notes.add("mouth-still", "the face does not move when it speaks", hint);
            }
        } else if !sources.contains_key("jawOpen") {
            notes.add(
                "mouth-by-visemes",
                "speech is made from visemes; lips move more coarsely than with ARKit's targets",
                "",
            );
        }
        if !has("eyeBlinkLeft") {
            notes.add(
                "lids-still",
                "the eyes do not blink",
                "add eyeBlinkLeft and eyeBlinkRight",
            );
        }
        if !has_eyes && !has("eyeLookUpLeft") && !has("eyeLookOutLeft") {
            notes.add(
                "eyes-still",
                "the eyes do not turn",
                "give the eyes bones of their own",
            );
        }
    }
}

fn channel(sources: &Sources, name: &'static str, sums: &[Sum], region: Region) -> Option<Channel> {
    let scaled = |key: &str, factor: f64| -> Option<Vec<WeightedTarget>> {
        let parts = sources.get(key)?.iter();
        Some(
            parts
                .map(|p| WeightedTarget {
                    factor: p.factor * factor,
                    ..*p
                })
                .collect(),
        )
    };
    if sources.contains_key(name) {
        // ARKit's lips close over its jaw at equal weights; ours at a jaw angle.
        let factor = if name == "mouthClose" { OVER_JAW } else { 1.0 };
        return Some(Channel {
            name,
            parts: scaled(name, factor)?,
            region: Region::Everywhere,
        });
    }
    // The first term must be there; subtracted ones may be missing.
    let sum = sums
        .iter()
        .find(|sum| sum.first().is_some_and(|(k, _)| sources.contains_key(k)))?;
    let parts = sum
        .iter()
        .filter_map(|(k, f)| scaled(k, *f))
        .flatten()
        .collect();
    let whole_face = !matches!(sum[0].0, "happy" | "surprised" | "angry" | "sad");
    Some(Channel {
        name,
        parts,
        region: if whole_face {
            Region::Everywhere
        } else {
            region
        },
    })
}

/// Returns VRM's expressions (1.0) or blend shape groups (0.x) as weighted morph targets by name.
fn expressions(json: &Value, root: &Document<'_>) -> Sources {
    let mut sources = Sources::new();
    let number = |v: &Value| v.as_u64().and_then(|n| usize::try_from(n).ok());
    let list = |v: &Value| v.as_array().cloned().unwrap_or_default();
    let mut add = |name: &str, parts: Vec<WeightedTarget>| {
        if let Some(key) = recognise_expression(name).filter(|_| !parts.is_empty()) {
            sources.entry(key).or_insert(parts);
        }
    };
    let one = &json["extensions"]["VRMC_vrm"]["expressions"];
    for table in ["preset", "custom"] {
        for (name, expression) in one[table].as_object().into_iter().flatten() {
            let bind = |b: &Value| {
                let node = root.nodes.get(number(&b["node"])?)?;
                Some(WeightedTarget {
                    mesh: node.mesh?,
                    target: number(&b["index"])?,
                    factor: b["weight"].as_f64().unwrap_or(1.0),
                })
            };
            let binds = list(&expression["morphTargetBinds"]);
            add(name, binds.iter().filter_map(bind).collect());
        }
    }
    for group in list(&json["extensions"]["VRM"]["blendShapeMaster"]["blendShapeGroups"]) {
        let bind = |b: &Value| {
            Some(WeightedTarget {
                mesh: number(&b["mesh"])?,
                target: number(&b["index"])?,
                // Percent.
                factor: b["weight"].as_f64().unwrap_or(100.0) / 100.0,
            })
        };
        let preset = group["presetName"].as_str().unwrap_or("unknown");
        let name = if preset.is_empty() || preset.eq_ignore_ascii_case("unknown") {
            group["name"].as_str().unwrap_or_default()
        } else {
            preset
        };
        add(
            name,
            list(&group["binds"]).iter().filter_map(bind).collect(),
        );
    }
    sources
}
