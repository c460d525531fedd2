//! Reader of the clip format: JSON keyframes, described in `docs/animation.md`.

use raconteur_base::{DQuat, DVec3, Length, Side};
use raconteur_body::Bone;
use raconteur_body::hand_shape::HandShape;
use serde::Deserialize;
use serde_json::Value;

use super::clip::{Clip, FootTrack, ReachKey, ReachTrack};
use super::curve::{Curve, Ease};
use super::joints;
use crate::members::{Members, items};

/// The longest text that is read, bytes. Sampled clips of a minute have some 300 KB.
const MAX_BYTES: usize = 8 << 20;
/// The longest clip, seconds.
const MAX_SECS: f64 = 3600.0;
/// Maximum number of keys of a track.
const MAX_KEYS: usize = 1 << 16;
/// Tolerance within which a loop's first and last key are equal: a rotation within 2°, a place
/// within 1 cm.
const NEAR: f64 = 0.015;
/// Keys nearer to each other than this count as one time, seconds.
const SAME_SECS: f64 = 1e-6;

/// Clip-wide fields of a clip file; fields of another type are ignored.
#[derive(Default, Deserialize)]
#[serde(default)]
struct ClipHeader {
    tracks: Option<Members>,
    seconds: Value,
    #[serde(rename = "loop")]
    repeats: Value,
    mirrored: Value,
    times: Value,
    ease: Value,
}

/// Parses a clip in the JSON keyframe format (docs/animation.md).
///
/// # Errors
/// Returns an error message that describes the problem and names the track.
pub fn read_clip(text: &str) -> Result<Clip, String> {
    if text.len() > MAX_BYTES {
        return Err("it is larger than 8 MB".to_owned());
    }
    let root: ClipHeader = serde_json::from_slice(text.as_bytes()).map_err(|e| e.to_string())?;
    let tracks = root.tracks.as_ref().ok_or("it has no tracks")?;
    let seconds = root.seconds.as_f64().unwrap_or(0.0);
    if !(0.0..=MAX_SECS).contains(&seconds) {
        return Err("its seconds are not between 0 and an hour".to_owned());
    }
    let mirrored = root.mirrored.as_bool().unwrap_or(false);
    let mut reader = Reader {
        root: &root,
        seconds,
        closed: root.repeats.as_bool().unwrap_or(false) || mirrored || seconds == 0.0,
        mirrored,
        halves: Vec::new(),
    };
    for (name, track) in &tracks.0 {
        let read = if track.is_object() {
            reader.track(name, track)
        } else {
            Err("expected an object".to_owned())
        };
        read.map_err(|why| format!("in the track {name}, {why}"))?;
    }
    reader.finish()
}

/// Data of one track.
#[derive(Clone, Debug, PartialEq)]
struct TrackData {
    part: TrackTarget,
    ease: Ease,
    keys: Vec<(f64, Values)>,
}

/// Target that a track moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum TrackTarget {
    Bone(Bone),
    Root,
    Foot(Side),
    Reach(Side),
}

/// A key of up to nine numbers: a rotation's first four; a foot's place, its knee and its three
/// angles; a hand's place and two directions.
type Values = [f64; 9];

impl TrackTarget {
    fn name(self) -> &'static str {
        match self {
            Self::Bone(bone) => bone.name(),
            Self::Root => "the root",
            Self::Foot(_) => "a foot",
            Self::Reach(_) => "a hand",
        }
    }

    fn mirrored(self) -> Self {
        match self {
            Self::Bone(bone) => Self::Bone(bone.mirrored()),
            Self::Root => Self::Root,
            Self::Foot(side) => Self::Foot(side.opposite()),
            Self::Reach(side) => Self::Reach(side.opposite()),
        }
    }

    /// Mirrors a key to the other side. Feet and hands count outwards, so their values stay the
    /// same.
    fn mirror(self, mut v: Values) -> Values {
        match self {
            Self::Bone(_) => {
                v[0] = -v[0];
                v[1] = -v[1];
            }
            Self::Root => v[0] = -v[0],
            Self::Foot(_) | Self::Reach(_) => {}
        }
        v
    }
}

struct Reader<'a> {
    root: &'a ClipHeader,
    seconds: f64,
    closed: bool,
    mirrored: bool,
    halves: Vec<TrackData>,
}

/// Angles and places of a foot: name, true for an angle, index in a key.
const FOOT: [(&str, bool, usize); 7] = [
    ("out", false, 0),
    ("up", false, 1),
    ("front", false, 2),
    ("knee", true, 3),
    ("heel", true, 4),
    ("turn", true, 5),
    ("roll", true, 6),
];

/// Columns of a hand's reach.
const REACH: [&str; 3] = ["place", "fingers", "palm"];

/// Reads keys of which some values are columns of a track: name, its unit, and the value's index.
fn filled(fields: &Value, n: usize, columns: &[(&str, f64, usize)]) -> Result<Vec<Values>, String> {
    let mut keys = vec![Values::default(); n];
    for &(name, unit, place) in columns {
        let column = numbers(fields, name, n, 0.0)?;
        for (key, value) in keys.iter_mut().zip(column) {
            key[place] = value * unit;
        }
    }
    Ok(keys)
}

/// Reads keys of a reach: place, direction of the fingers and of the palm.
fn reached(fields: &Value, n: usize) -> Result<Vec<Values>, String> {
    let mut keys = vec![Values::default(); n];
    for (i, name) in REACH.into_iter().enumerate() {
        let unit = if i == 0 { 0.01 } else { 1.0 };
        for (key, v) in keys.iter_mut().zip(triples(fields, name, n, i == 0)?) {
            (0..3).for_each(|k| key[3 * i + k] = v[k] * unit);
        }
    }
    Ok(keys)
}

impl Reader<'_> {
    fn track(&mut self, name: &str, fields: &Value) -> Result<(), String> {
        let times = self.times(fields)?;
        let n = times.len();
        let ease = self.ease(fields)?;
        let mut allowed = vec!["times", "ease"];
        let add = |halves: &mut Vec<TrackData>, part: TrackTarget, keys: Vec<Values>| {
            halves.push(TrackData {
                part,
                ease,
                keys: times.iter().copied().zip(keys).collect(),
            });
        };
        let (bare, sides) = joints::sides_of(name);
        if let Some((joint, sides)) = joints::find(name) {
            allowed.extend_from_slice(joint.angles());
            let mut angles = [const { Vec::new() }; 3];
            for (i, column) in angles.iter_mut().enumerate() {
                let angle = joint.angles().get(i).copied().unwrap_or_default();
                *column = numbers(fields, angle, n, 0.0)?;
            }
            let turns = (0..n).map(|k| joint.rotation([angles[0][k], angles[1][k], angles[2][k]]));
            let left: Vec<Values> = turns.map(of_rotation).collect();
            for side in sides.unwrap_or(&[Side::Left]) {
                let part = TrackTarget::Bone(joint.bone);
                match side {
                    Side::Left => add(&mut self.halves, part, left.clone()),
                    Side::Right => {
                        let right = left.iter().map(|v| part.mirror(*v)).collect();
                        add(&mut self.halves, part.mirrored(), right);
                    }
                }
            }
        } else if name == "root" {
            let names = ["left", "up", "front"];
            allowed.extend(names);
            let columns = [0, 1, 2].map(|i| (names[i], 0.01, i));
            add(
                &mut self.halves,
                TrackTarget::Root,
                filled(fields, n, &columns)?,
            );
        } else if let ("hand", Some(sides)) = (bare, sides) {
            allowed.push("shape");
            let shapes = shapes(fields, n)?;
            for &side in sides {
                for finger in 0..15 {
                    let turns = shapes.iter().map(|s| s.rotations(side)[finger]);
                    let bone = shapes[0].rotations(side)[finger].0;
                    let keys = turns.map(|(_, q)| of_rotation(q)).collect();
                    add(&mut self.halves, TrackTarget::Bone(bone), keys);
                }
            }
        } else if let ("foot", Some(sides)) = (bare, sides) {
            allowed.extend(FOOT.map(|(name, ..)| name));
            let columns = FOOT.map(|(name, is_angle, i)| {
                let unit = if is_angle { 1f64.to_radians() } else { 0.01 };
                (name, unit, i)
            });
            let keys = filled(fields, n, &columns)?;
            for &side in sides {
                add(&mut self.halves, TrackTarget::Foot(side), keys.clone());
            }
        } else if let ("reach", Some(sides)) = (bare, sides) {
            allowed.extend(REACH);
            let keys = reached(fields, n)?;
            for &side in sides {
                add(&mut self.halves, TrackTarget::Reach(side), keys.clone());
            }
        } else if let Some(bone) = Bone::from_name(name) {
            allowed.push("rotation");
            let rotations = rotations(fields, n)?;
            add(&mut self.halves, TrackTarget::Bone(bone), rotations);
        } else {
            return Err("the name is of no joint, foot, hand or bone".to_owned());
        }
        let mut names = fields.as_object().into_iter().flat_map(|all| all.keys());
        match names.find(|name| !allowed.contains(&name.as_str())) {
            Some(unknown) => Err(format!("there is no {unknown}")),
            None => Ok(()),
        }
    }

    /// Returns the key times of a track, seconds: its own, otherwise those of the clip, otherwise a
    /// single key at 0.
    fn times(&self, fields: &Value) -> Result<Vec<f64>, String> {
        let list = value_or_common(&fields["times"], &self.root.times);
        if list.is_null() {
            return Ok(vec![0.0]);
        }
        let times: Option<Vec<f64>> = items(list).iter().map(Value::as_f64).collect();
        let times = times.unwrap_or_default();
        // A mirrored clip is written by its first half.
        let end = self.seconds * if self.mirrored { 0.5 } else { 1.0 };
        let ascending = times.windows(2).all(|w| w[1] - w[0] > SAME_SECS);
        let inside = times.iter().all(|t| (0.0..=end + SAME_SECS).contains(t));
        if times.is_empty() || times.len() > MAX_KEYS || !ascending || !inside {
            return Err("the times do not ascend from 0 to the end".to_owned());
        }
        Ok(times)
    }

    fn ease(&self, fields: &Value) -> Result<Ease, String> {
        let word = value_or_common(&fields["ease"], &self.root.ease);
        if word.is_null() {
            return Ok(Ease::Flow);
        }
        let found = Ease::WORDS.iter().find(|(w, _)| word.as_str() == Some(w));
        let found = found.map(|(_, ease)| *ease);
        found.ok_or_else(|| "ease is not flow, rest, linear or step".to_owned())
    }

    /// Adds to each half the mirrored motion of the other side, delayed by half a period.
    fn with_mirrored_halves(&self) -> Vec<TrackData> {
        let mut parts: Vec<TrackTarget> = Vec::new();
        for half in &self.halves {
            for part in [half.part, half.part.mirrored()] {
                if !parts.contains(&part) {
                    parts.push(part);
                }
            }
        }
        let own = |part: TrackTarget| self.halves.iter().rev().find(|h| h.part == part);
        let later = 0.5 * self.seconds;
        let joined = parts.into_iter().filter_map(|part| {
            let (first, second) = (own(part), own(part.mirrored()));
            let written = first.or(second)?;
            // A side without keys waits where the other ends and begins.
            let still = |half: &TrackData| vec![(0.0, part.mirror(half.keys[0].1))];
            let mut keys = match (first, second) {
                (Some(first), _) => first.keys.clone(),
                (None, Some(second)) => still(second),
                (None, None) => return None,
            };
            let mirrored = match second {
                Some(second) => second
                    .keys
                    .iter()
                    .map(|(t, v)| (t + later, part.mirror(*v)))
                    .collect(),
                None => first.map(|h| vec![(later, h.keys[0].1)])?,
            };
            // A key at the middle is written by both; they should agree.
            keys.retain(|(t, _)| mirrored.first().is_none_or(|(m, _)| t + SAME_SECS < *m));
            keys.extend(
                mirrored
                    .into_iter()
                    .filter(|(t, _)| *t < self.seconds - SAME_SECS),
            );
            Some(TrackData {
                part,
                ease: written.ease,
                keys,
            })
        });
        joined.collect()
    }

    fn finish(self) -> Result<Clip, String> {
        let mut clip = Clip {
            duration_secs: self.seconds,
            closed: self.closed,
            ..Clip::default()
        };
        let period = (self.closed && self.seconds > 0.0).then_some(self.seconds);
        let tracks = if self.mirrored {
            self.with_mirrored_halves()
        } else {
            self.halves
        };
        for (i, track) in tracks.iter().enumerate() {
            let ends = track.keys.first().zip(track.keys.last());
            if let (Some(period), Some((first, last))) = (period, ends) {
                let apart = first.1.iter().zip(last.1).map(|(a, b)| (a - b).abs());
                let spans = last.0 - first.0 > period - SAME_SECS;
                if spans && apart.fold(0.0, f64::max) > NEAR {
                    let part = track.part.name();
                    return Err(format!(
                        "it loops, but {part} ends elsewhere than it begins"
                    ));
                }
            }
            // Of two tracks for one part the later one counts.
            if tracks[i + 1..].iter().any(|t| t.part == track.part) {
                continue;
            }
            let times: Vec<f64> = track.keys.iter().map(|k| k.0).collect();
            let curve = |from: usize, scale: f64| {
                let values: Vec<[f64; 4]> = track
                    .keys
                    .iter()
                    .map(|(_, v)| core::array::from_fn(|k| scale * v[from + k]))
                    .collect();
                Curve::new(&times, &values, track.ease, period)
            };
            match track.part {
                TrackTarget::Bone(bone) => {
                    let turns: Vec<DQuat> = track
                        .keys
                        .iter()
                        .map(|(_, v)| DQuat::from_xyzw(v[0], v[1], v[2], v[3]))
                        .collect();
                    let curve = Curve::of_rotations(&times, &turns, track.ease, period);
                    clip.bones.push((bone, curve));
                }
                TrackTarget::Root => clip.root = Some(curve(0, 1.0)),
                TrackTarget::Foot(side) => {
                    clip.feet[side.index()] = Some(FootTrack {
                        place: curve(0, 1.0),
                        turn: curve(4, 1.0),
                    });
                }
                TrackTarget::Reach(side) => clip.reaches.push(ReachTrack {
                    side,
                    ease: track.ease,
                    keys: track
                        .keys
                        .iter()
                        .map(|(time_secs, v)| ReachKey {
                            time_secs: *time_secs,
                            place: DVec3::new(v[0], v[1], v[2]),
                            fingers: DVec3::new(v[3], v[4], v[5]),
                            palm: DVec3::new(v[6], v[7], v[8]),
                        })
                        .collect(),
                }),
            }
        }
        Ok(clip)
    }
}

fn of_rotation(q: DQuat) -> Values {
    [q.x, q.y, q.z, q.w, 0.0, 0.0, 0.0, 0.0, 0.0]
}

/// Returns the track's own value, else the value common to the clip.
fn value_or_common<'v>(own: &'v Value, common: &'v Value) -> &'v Value {
    if own.is_null() { common } else { own }
}

/// Returns `n` numbers of a field: a list of `n`, or one number repeated; `default` if the field is
/// absent.
fn numbers(fields: &Value, name: &str, n: usize, default: f64) -> Result<Vec<f64>, String> {
    let value = &fields[name];
    if value.is_null() {
        return Ok(vec![default; n]);
    }
    let list = if value.is_array() {
        items(value).iter().map(Value::as_f64).collect()
    } else {
        value.as_f64().map(|x| vec![x; n])
    };
    list.filter(|l: &Vec<f64>| l.len() == n && l.iter().all(|x| x.abs() < 1e6))
        .ok_or_else(|| format!("{name} is not one number or as many as there are times"))
}

/// Returns a column of lists of `N` numbers, or one such list repeated for all keys.
fn rows<const N: usize>(value: &Value, n: usize) -> Option<Vec<[f64; N]>> {
    let row = |v: &Value| -> Option<[f64; N]> {
        let list = items(v);
        if list.len() != N {
            return None;
        }
        let mut out = [0.0; N];
        for (o, x) in out.iter_mut().zip(list) {
            *o = x.as_f64().filter(|x| x.abs() < 1e6)?;
        }
        Some(out)
    };
    let list = items(value);
    if list.first().is_some_and(|x| x.as_f64().is_some()) {
        return row(value).map(|r| vec![r; n]);
    }
    let rows: Option<Vec<[f64; N]>> = list.iter().map(row).collect();
    rows.filter(|r| r.len() == n)
}

fn triples(fields: &Value, name: &str, n: usize, needed: bool) -> Result<Vec<[f64; 3]>, String> {
    let value = &fields[name];
    let found = if value.is_null() {
        (!needed).then(|| vec![[0.0; 3]; n])
    } else {
        rows(value, n)
    };
    found.ok_or_else(|| format!("{name} is not a list of three numbers for each time"))
}

fn rotations(fields: &Value, n: usize) -> Result<Vec<Values>, String> {
    let found = rows::<4>(&fields["rotation"], n);
    let mut out = Vec::new();
    for [x, y, z, w] in found.unwrap_or_default() {
        let q = DQuat::from_xyzw(x, y, z, w);
        if q.length_squared() > 1e-6 {
            out.push(of_rotation(q.normalized()));
        }
    }
    if out.len() == n {
        Ok(out)
    } else {
        Err("rotation is not a quaternion x, y, z, w for each time".to_owned())
    }
}

/// Returns the hand shapes that a track names by their numbers in the dictionary, one per key.
fn shapes(fields: &Value, n: usize) -> Result<Vec<&'static HandShape>, String> {
    let ids = numbers(fields, "shape", n, 0.0)?;
    let shape = |id: &f64| {
        let whole = (0.0..=255.0).contains(id) && id.fract() == 0.0;
        whole.then(|| HandShape::get(*id as u8)).flatten()
    };
    let found: Option<Vec<_>> = ids.iter().map(shape).collect();
    found.ok_or_else(|| "there is no hand shape of that number".to_owned())
}
