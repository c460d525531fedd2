//! What a style tells the grower.

use raconteur_base::DVec3;

use super::HairParams;
use crate::part::JointRef;
use raconteur_body::skeleton::{Bone, Drive};

/// 0 at `from` and beyond, 1 at `to` and beyond, whichever is greater.
pub(super) fn slope(from: f64, to: f64, x: f64) -> f64 {
    ((x - from) / (to - from)).clamp(0.0, 1.0)
}

/// How the renderer fills a card.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Weave {
    /// No gaps but at sides and tips.
    Dense,
    /// Some gaps.
    Loose,
    /// Single hairs.
    Wisp,
    /// Short hair on the skin itself.
    Cap,
}

/// Where a layer's cards are rooted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Where {
    /// All over.
    All,
    /// Along the hairline of forehead and temples.
    Hairline,
    /// Along the parting.
    Parting,
}

/// Cards of one height above the scalp.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layer {
    pub(super) cards: usize,
    /// Spans of a card.
    pub(super) spans: usize,
    /// Height above the skin, metres.
    pub(super) height: f64,
    /// Width of a card, metres.
    pub(super) width: f64,
    /// Openness at root and tip, 0..1.
    pub(super) open: [f64; 2],
    /// Length against the full one.
    pub(super) length: f64,
    /// Longest card, metres.
    pub(super) longest: f64,
    pub(super) roots: Where,
    pub(super) weave: Weave,
}

/// The usual layer; tables say what differs.
pub(super) const LAYER: Layer = Layer {
    cards: 100,
    spans: 5,
    height: 0.006,
    width: 0.016,
    open: [0.6, 0.8],
    length: 1.0,
    longest: 0.6,
    roots: Where::All,
    weave: Weave::Dense,
};

/// How hair gathers.
#[derive(Clone, Copy, Debug)]
pub(super) struct Locks {
    /// How many there are.
    pub(super) count: usize,
    /// Share by which the tips of a lock come together.
    pub(super) gather: f64,
    /// Spread of the direction in which locks lie, as a tangent.
    pub(super) unruly: f64,
}

/// One style. All places are on the common head, metres.
pub(super) trait Cut {
    fn layers(&self) -> &[Layer];
    fn locks(&self) -> Locks;
    /// Share of the scalp's hair that stands at a place.
    fn density(&self, _at: DVec3) -> f64 {
        1.0
    }
    /// Where along the parting this place lies: 1 on it, 0 off it.
    fn parting(&self, _at: DVec3) -> f64 {
        0.0
    }
    /// Direction in which hair leaves its root; what points into the head is taken away.
    fn comb(&self, at: DVec3) -> DVec3;
    /// How steeply it leaves, as a share of the normal.
    fn lift(&self, at: DVec3) -> f64;
    /// What bends a lock on its way: added to the direction per centimetre. `t` is the
    /// share of its longest way behind it.
    fn bend(&self, at: DVec3, root: DVec3, t: f64) -> DVec3;
    /// Longest way from root to tip.
    fn length(&self, root: DVec3) -> f64;
    /// Height at which hair rooted there is cut while it hangs at `at`, if it is.
    fn hem(&self, _root: DVec3, _at: DVec3) -> Option<f64> {
        None
    }
    /// Whether hair rooted there passes over the ear; if not, it ends before it.
    fn over_ear(&self, _root: DVec3) -> bool {
        false
    }
    /// Height of the volume against a layer's own at a place.
    fn volume(&self, _at: DVec3) -> f64 {
        1.0
    }
    /// Share by which hair is drawn to its layer's height in each centimetre.
    fn cling(&self, _at: DVec3) -> f64 {
        0.3
    }
    /// Width of waves, metres.
    fn wave(&self) -> f64 {
        0.0
    }
    /// The joints that carry a place.
    fn hang(&self, _at: DVec3) -> Vec<(JointRef, f64)> {
        vec![(JointRef(Drive::Bone(Bone::Skull)), 1.0)]
    }
    /// Cards that the combing does not make.
    fn extra(&self) -> Vec<Coil> {
        Vec::new()
    }
}

/// A lock laid by hand, on the common head.
pub(super) struct Coil {
    pub(super) curve: Vec<DVec3>,
    pub(super) normals: Vec<DVec3>,
    pub(super) width: f64,
}

/// What age leaves at a place: temples recede, the crown thins. After Norwood's stages
/// (1975, doi:10.1097/00007611-197511000-00009), smoothed; designed.
pub(super) fn kept(p: &HairParams, at: DVec3) -> f64 {
    let mm = at * 1e3;
    let forehead = slope(20.0, 55.0, mm.z);
    let temple = slope(8.0, 30.0, mm.x.abs()) * (1.0 - slope(54.0, 66.0, mm.x.abs()));
    // The line moves up by as much as 34 mm at the temples and 14 in the middle.
    let line = 80.0 + p.recession * (12.0 + 24.0 * temple);
    let front = 1.0
        - forehead
            * (1.0 - slope(line - 3.0, line + 9.0, mm.y))
            * p.recession.min(0.25)
            * 4.0
            * slope(60.0, 78.0, mm.y);
    let (dx, dz) = (mm.x / 46.0, (mm.z + 22.0) / 62.0);
    let crown = raconteur_base::ops::exp(-dx * dx - dz * dz) * slope(70.0, 105.0, mm.y);
    front * (1.0 - 0.75 * p.thinning * crown)
}
