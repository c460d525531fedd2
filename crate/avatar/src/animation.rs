//! Import of animations: clips from other files become clips for any figure.
//!
//! Each bone turns in the world as in the file, relative to the file's rest pose; the difference
//! between the rest pose and the zero pose is known from the import of the figure. The result is
//! the text of a clip (`docs/animation.md`) with a key for every 30th of a second, so that a page's
//! player needs only one format.

use raconteur_base::{DAffine3, DMat4, DQuat, DVec3};
use serde_json::{Map, Value, json};

use super::container::Container;
use super::error::{DiagnosticSink, ImportError};
use super::humanoid::{Humanoid, has_vrm_table};
use super::tree::Tree;
use super::{MAX_NUMBERS, align, frames, unposed};
use raconteur_body::pose::Pose;
use raconteur_body::read::accessor::Source;
use raconteur_body::read::document::Node;
use raconteur_body::read::{ReadError, solve_nodes};
use raconteur_body::skeleton::Bone;

/// Keys a second.
const RATE_HZ: f64 = 30.0;
/// Maximum duration of an imported animation, seconds.
const MAX_SECS: f64 = 600.0;
/// A head's height above its joint, as a share of the joint's height: the stature follows.
const HEAD_SHARE: f64 = 0.12;

/// Interpolation between the keys of a sampler.
#[derive(Clone, Copy, PartialEq)]
enum Interpolation {
    Step,
    Linear,
    Cubic,
}

/// Property animated by a channel.
#[derive(Clone, Copy, PartialEq)]
enum Path {
    Translation,
    Rotation,
}

struct Channel {
    node: usize,
    path: Path,
    times: Vec<f64>,
    /// Values of the keys, one per key; three (in-tangent, value, out-tangent) for cubic ones.
    values: Vec<[f64; 4]>,
    interpolation: Interpolation,
}

/// Turns an animation of a humanoid glTF, GLB or VRM into the text of a clip: the one of this
/// name, or the first for an empty name.
///
/// # Errors
/// Returns an [`ImportError`] that describes the problem.
pub fn convert_animation(name: &str, bytes: &[u8]) -> Result<String, ImportError> {
    let container = Container::open(bytes)?;
    let json = &container.root;
    let root = container.document()?;
    let world = solve_nodes(&root)?;
    if world.iter().any(|w| !w.is_finite()) {
        return Err(ReadError::NotFinite {
            what: "a node's placement",
        }
        .into());
    }
    let animations = json["animations"].as_array().map_or(&[][..], Vec::as_slice);
    let mut wanted = animations
        .iter()
        .filter(|a| name.is_empty() || a["name"].as_str() == Some(name));
    let animation = wanted.next().ok_or(ReadError::OutOfRange {
        what: "the animation's name",
    })?;
    let mut source = Source::with_budget(&root, MAX_NUMBERS);
    let channels = channels(animation, root.nodes.len(), &mut source)?;

    let mut notes = DiagnosticSink::default();
    let mut tree = Tree::new(&root, world);
    let mut humanoid = Humanoid::find(json, &tree, &mut notes)?;
    if !has_vrm_table(json)
        && let Some(world) = unposed::world(&tree, &humanoid, &mut source)?
    {
        tree.world = world;
    }
    let stance = align::RestStance::find(&tree, &mut humanoid, &mut notes)?;
    let places = || {
        Bone::ALL
            .iter()
            .filter_map(|b| humanoid.get(*b))
            .map(|n| stance.turn * tree.place(n))
    };
    let low = places().fold(DVec3::MAX, DVec3::min);
    let mut high = places().fold(DVec3::MIN, DVec3::max);
    if let Some(skull) = humanoid.get(Bone::Skull) {
        let joint = (stance.turn * tree.place(skull)).y;
        high.y = joint + HEAD_SHARE * (joint - low.y);
    }
    let alignment = stance.align(&tree, &humanoid, low, high, &mut notes)?;
    let rest = frames::rest(&tree, &humanoid, &alignment);
    let mut sampler = Sampler {
        tree: &tree,
        humanoid: &humanoid,
        channels: &channels,
        turn: stance.turn,
        scale: alignment.ours_from_theirs.matrix3.x_axis.length() / alignment.stature_m,
        bind: rest
            .inverse_bind
            .iter()
            .take(Bone::COUNT)
            .map(|m| DQuat::from_mat3(&m.inverse().matrix3).normalize())
            .collect(),
        zero: rest
            .skeleton
            .joints()
            .iter()
            .map(|j| j.zero_rotation)
            .collect(),
        world: Vec::new(),
    };
    let ends = channels.iter().filter_map(|c| c.times.last().copied());
    let length = ends.fold(0.0, f64::max);
    if length > MAX_SECS {
        return Err(ReadError::TooLarge.into());
    }
    let steps = (length * RATE_HZ).ceil().max(1.0);
    let samples: Vec<(Pose, f64)> = (0..=steps as usize)
        .map(|i| {
            let t = length * i as f64 / steps;
            (sampler.pose(t), t)
        })
        .collect();
    Ok(text(&samples, length, &humanoid))
}

fn channels(
    animation: &Value,
    nodes: usize,
    source: &mut Source<'_>,
) -> Result<Vec<Channel>, ImportError> {
    let what = "an animation";
    let index = |v: &Value| v.as_u64().and_then(|n| usize::try_from(n).ok());
    let mut out = Vec::new();
    for channel in animation["channels"].as_array().into_iter().flatten() {
        let path = match channel["target"]["path"].as_str() {
            Some("translation") => Path::Translation,
            Some("rotation") => Path::Rotation,
            // Bones that grow are no movement of a skeleton, and faces have their own.
            _ => continue,
        };
        let Some(node) = index(&channel["target"]["node"]).filter(|n| *n < nodes) else {
            continue;
        };
        let sampler = index(&channel["sampler"])
            .and_then(|i| animation["samplers"].get(i))
            .ok_or(ReadError::OutOfRange { what })?;
        let accessor = |key: &str| index(&sampler[key]).ok_or(ReadError::OutOfRange { what });
        let interpolation = match sampler["interpolation"].as_str() {
            Some("STEP") => Interpolation::Step,
            Some("CUBICSPLINE") => Interpolation::Cubic,
            _ => Interpolation::Linear,
        };
        let times: Vec<[f32; 1]> = source.dense(accessor("input")?, what)?;
        let times: Vec<f64> = times.into_iter().map(|[t]| f64::from(t)).collect();
        let output = accessor("output")?;
        let values: Vec<[f64; 4]> = match path {
            Path::Rotation => source
                .dense::<4>(output, what)?
                .into_iter()
                .map(|v| v.map(f64::from))
                .collect(),
            Path::Translation => source
                .dense::<3>(output, what)?
                .into_iter()
                .map(|[x, y, z]| [f64::from(x), f64::from(y), f64::from(z), 0.0])
                .collect(),
        };
        let each = if interpolation == Interpolation::Cubic {
            3
        } else {
            1
        };
        let ascending = times.windows(2).all(|w| w[0] < w[1]);
        if times.is_empty() || !ascending || values.len() != each * times.len() {
            return Err(ReadError::Count { what }.into());
        }
        out.push(Channel {
            node,
            path,
            times,
            values,
            interpolation,
        });
    }
    if out.is_empty() {
        let what = "the channels of the animation";
        return Err(ReadError::OutOfRange { what }.into());
    }
    Ok(out)
}

impl Channel {
    fn sample(&self, t: f64) -> [f64; 4] {
        let cubic = self.interpolation == Interpolation::Cubic;
        let value = |i: usize| self.values[if cubic { 3 * i + 1 } else { i }];
        let next = self.times.partition_point(|x| *x <= t);
        let Some(i) = next.checked_sub(1) else {
            return value(0);
        };
        if next >= self.times.len() || self.interpolation == Interpolation::Step {
            return value(i);
        }
        let h = self.times[next] - self.times[i];
        let s = (t - self.times[i]) / h;
        let (a, b) = (value(i), value(next));
        if cubic {
            let (out, into) = (self.values[3 * i + 2], self.values[3 * next]);
            let mixed =
                |k: usize| raconteur_base::curve::hermite(a[k], h * out[k], b[k], h * into[k], s);
            return core::array::from_fn(mixed);
        }
        if self.path == Path::Rotation {
            let [a, b] = [a, b].map(rotation);
            return a.slerp(b, s).to_array();
        }
        core::array::from_fn(|k| a[k] + (b[k] - a[k]) * s)
    }
}

fn rotation(v: [f64; 4]) -> DQuat {
    let q = DQuat::from_array(v);
    if q.length_squared() > 1e-12 {
        q.normalize()
    } else {
        DQuat::IDENTITY
    }
}

/// The file's skeleton at any time, as ours.
struct Sampler<'a> {
    tree: &'a Tree<'a>,
    humanoid: &'a Humanoid,
    channels: &'a [Channel],
    turn: DQuat,
    /// Shares of stature in the file's unit.
    scale: f64,
    /// World from bone in the rest pose.
    bind: Vec<DQuat>,
    /// Parent from bone in our zero pose.
    zero: Vec<DQuat>,
    world: Vec<DAffine3>,
}

impl Sampler<'_> {
    fn local(&self, node: &Node, index: usize, t: f64) -> DAffine3 {
        let (mut scale, mut turn, mut place) = match node.matrix {
            Some(m) => {
                DAffine3::from_mat4(DMat4::from_cols_array(&m)).to_scale_rotation_translation()
            }
            None => (
                node.scale.map_or(DVec3::ONE, DVec3::from_array),
                node.rotation.map_or(DQuat::IDENTITY, rotation),
                node.translation.map_or(DVec3::ZERO, DVec3::from_array),
            ),
        };
        if !scale.is_finite() {
            scale = DVec3::ONE;
        }
        for channel in self.channels.iter().filter(|c| c.node == index) {
            let v = channel.sample(t);
            match channel.path {
                Path::Rotation => turn = rotation(v),
                Path::Translation => place = DVec3::new(v[0], v[1], v[2]),
            }
        }
        DAffine3::from_scale_rotation_translation(scale, turn, place)
    }

    /// Returns the pose at time `t`, seconds: rotations, and the root's displacement as a share of
    /// stature.
    fn pose(&mut self, t: f64) -> Pose {
        let mut world = std::mem::take(&mut self.world);
        world.resize(self.tree.parents.len(), DAffine3::IDENTITY);
        for &node in &self.tree.order {
            let local = self.local(&self.tree.root.nodes[node], node, t);
            world[node] = self.tree.parents[node].map_or(local, |p| world[p] * local);
        }
        let turned = |m: &DAffine3| m.to_scale_rotation_translation().1;
        let mut pose = Pose::zero();
        let mut ours = [DQuat::IDENTITY; Bone::COUNT];
        let mut deltas = [DQuat::IDENTITY; Bone::COUNT];
        for bone in Bone::ALL {
            let (i, parent) = (bone.index(), bone.parent().map(Bone::index));
            deltas[i] = match self.humanoid.get(bone) {
                Some(node) => {
                    let delta = turned(&world[node]) * turned(&self.tree.world[node]).inverse();
                    (self.turn * delta * self.turn.inverse()).normalize()
                }
                // A bone missing from the file moves with its parent.
                None => parent.map_or(DQuat::IDENTITY, |p| deltas[p]),
            };
            ours[i] = (deltas[i] * self.bind[i]).normalize();
            let local = parent.map_or(ours[i], |p| ours[p].inverse() * ours[i]);
            pose.set(bone, (self.zero[i].inverse() * local).normalize());
        }
        if let Some(hips) = self.humanoid.get(Bone::Sacroiliac) {
            let moved = world[hips].translation - self.tree.place(hips);
            pose.root_offset_in_world = self.turn * moved * self.scale;
        }
        self.world = world;
        pose
    }
}

/// Returns the text of a clip with these sampled poses, in the clip format.
fn text(samples: &[(Pose, f64)], length: f64, humanoid: &Humanoid) -> String {
    let round = |x: f64| (x * 1e5).round() / 1e5;
    let mut tracks = Map::new();
    for bone in Bone::ALL {
        // Other layers may move a bone that the file lacks.
        if humanoid.get(bone).is_none() {
            continue;
        }
        let turns: Vec<DQuat> = samples
            .iter()
            .map(|(pose, _)| pose.rotation(bone))
            .collect();
        let row = |q: &DQuat| json!(q.to_array().map(round));
        let still = turns.iter().all(|q| q.angle_between(turns[0]) < 1e-3);
        let track = if still {
            json!({ "times": [0], "rotation": row(&turns[0]) })
        } else {
            json!({ "rotation": turns.iter().map(row).collect::<Vec<_>>() })
        };
        tracks.insert(bone.name().to_owned(), track);
    }
    let column = |k: usize| {
        let values = samples.iter();
        let values = values.map(|(pose, _)| round(100.0 * pose.root_offset_in_world[k]));
        values.collect::<Vec<f64>>()
    };
    tracks.insert(
        "root".to_owned(),
        json!({ "left": column(0), "up": column(1), "front": column(2) }),
    );
    let same = |a: &Pose, b: &Pose| {
        let turns = a.rotations.iter().zip(&b.rotations);
        turns.into_iter().all(|(p, q)| p.angle_between(*q) < 0.02)
            && a.root_offset_in_world.distance(b.root_offset_in_world) < 0.005
    };
    let closed = samples
        .first()
        .zip(samples.last())
        .is_some_and(|(a, b)| same(&a.0, &b.0));
    json!({
        "about": "converted from glTF",
        "seconds": length,
        "loop": closed,
        "ease": "linear",
        "times": samples.iter().map(|(_, t)| *t).collect::<Vec<f64>>(),
        "tracks": tracks,
    })
    .to_string()
}
