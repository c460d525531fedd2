//! Conversion between GSL and the keys of EML's gestures, exact in both directions.

use raconteur_base::Side;
use raconteur_eml::{Coords, Key, MotionKey, PalmKey, ShapeKey, Span, Track};

use super::feature::Feature;
use super::{Item, Offset, Palm, Position, Sequence, Shape, Value};

/// Feature with a corresponding value in EML.
pub trait InEml: Feature {
    /// Value of an EML key.
    type Key: Clone + PartialEq;

    /// Converts to EML's frame.
    fn to_eml(&self) -> Self::Key;

    /// Converts from EML's frame; `None` if GSL cannot express the key: blended hand shapes, and
    /// positions in world coordinates.
    fn from_eml(key: &Self::Key) -> Option<Self>;
}

/// Negates z, which is to the front in GSL and to the back in EML. A zero has no sign.
fn flip([x, y, z]: [f64; 3]) -> [f64; 3] {
    [x, y, 0.0 - z]
}

impl InEml for Shape {
    type Key = ShapeKey;

    fn to_eml(&self) -> ShapeKey {
        ShapeKey {
            id: self.0,
            blend: None,
        }
    }

    fn from_eml(key: &ShapeKey) -> Option<Self> {
        key.blend.is_none().then_some(Self(key.id))
    }
}

impl InEml for Palm {
    type Key = PalmKey;

    /// The left-hand rule is physical, so the angle keeps its sign in the mirrored frame.
    fn to_eml(&self) -> PalmKey {
        PalmKey {
            angle_deg: self.angle_deg,
            axis: flip(self.axis),
        }
    }

    fn from_eml(key: &PalmKey) -> Option<Self> {
        Some(Self {
            angle_deg: key.angle_deg,
            axis: flip(key.axis),
        })
    }
}

impl InEml for Position {
    type Key = MotionKey;

    fn to_eml(&self) -> MotionKey {
        MotionKey {
            position: flip(self.0),
            coords: Coords::Speaker,
        }
    }

    fn from_eml(key: &MotionKey) -> Option<Self> {
        (key.coords == Coords::Speaker).then_some(Self(flip(key.position)))
    }
}

/// Converts a value to EML tracks for a phase of a duration, seconds: one, or one per hand. Keys are
/// in the order of time.
#[must_use]
pub fn tracks<F: InEml>(value: &Value<F>, duration_secs: f64, span: Span) -> Vec<Track<F::Key>> {
    let track = |hand: Option<Side>, sequence: &Sequence<F>| {
        let times = sequence.offsets_secs(duration_secs);
        let items = times.into_iter().zip(&sequence.items);
        let mut keys: Vec<Key<F::Key>> = items
            .map(|(offset_secs, item)| Key {
                offset_secs,
                value: item.feature.to_eml(),
                profile: None,
                span,
            })
            .collect();
        raconteur_base::order::sort_by_number(&mut keys, |key| key.offset_secs);
        Track {
            hand,
            keys,
            profile: None,
            span,
        }
    };
    match value {
        Value::Common(sequence) => vec![track(None, sequence)],
        Value::PerHand { .. } => Side::BOTH
            .into_iter()
            .filter_map(|side| Some(track(Some(side), value.for_hand(side)?)))
            .collect(),
    }
}

/// Converts EML tracks of one feature to GSL. Times are in seconds, except that of a single key at
/// the beginning. `None` without tracks, and if GSL cannot express a key.
#[must_use]
pub fn from_tracks<F: InEml>(tracks: &[Track<F::Key>]) -> Option<Value<F>> {
    let sequence = |track: &Track<F::Key>| {
        let is_plain = track.keys.len() == 1 && track.keys[0].offset_secs == 0.0;
        let item = |key: &Key<F::Key>| {
            Some(Item {
                offset: (!is_plain).then_some(Offset::Secs(key.offset_secs)),
                feature: F::from_eml(&key.value)?,
            })
        };
        let items: Option<Vec<Item<F>>> = track.keys.iter().map(item).collect();
        Some(Sequence { items: items? })
    };
    if let Some(common) = tracks.iter().find(|track| track.hand.is_none()) {
        return Some(Value::Common(sequence(common)?));
    }
    let of = |side: Side| {
        let track = tracks.iter().find(|track| track.hand == Some(side));
        track.map(sequence)
    };
    let (right, left) = (of(Side::Right), of(Side::Left));
    if right.is_none() && left.is_none() {
        return None;
    }
    // A hand that GSL cannot express loses the whole, rather than half of a gesture.
    Some(Value::PerHand {
        right: right.map_or(Some(None), |r| r.map(Some))?,
        left: left.map_or(Some(None), |l| l.map(Some))?,
    })
}
