//! What hair lies on: skin, ears and the dressed body.

use raconteur_base::{DVec3, ops};

use super::BodyDistance;
use super::cut::slope;
use super::skin::Skin;
use crate::head::{Ear, Head, Proportions};
use crate::subdivide::vertex_normals;

/// Room between hair and an ear, metres.
const EAR_MARGIN: f64 = 0.0025;
/// Room between hair and the body's surface: the cloth lies between.
const BODY_MARGIN: f64 = 0.012;

/// Everything a strand must stay out of.
pub(super) struct Ground<'a> {
    pub(super) skin: Skin,
    ears: [Ear; 2],
    proportions: Proportions,
    body: &'a BodyDistance<'a>,
}

impl<'a> Ground<'a> {
    pub(super) fn new(head: &Head, body: &'a BodyDistance<'a>) -> Self {
        let part = head.skin();
        let positions: Vec<DVec3> = part.vertices.iter().map(|v| v.position).collect();
        let normals = vertex_normals(&positions, &part.faces);
        let ears = head.scalp.ears;
        let floor = -1.12 * head.scalp.proportions.menton;
        let kept = |p: DVec3| {
            // Below the skull's base the neck is the body's.
            p.y > floor && !ears.iter().any(|e| inside(e, p, 0.0015))
        };
        Self {
            skin: Skin::new(
                positions
                    .into_iter()
                    .zip(normals)
                    .filter(|(p, _)| kept(*p))
                    .collect(),
            ),
            ears,
            proportions: head.scalp.proportions,
            body,
        }
    }

    /// The place on the common head.
    pub(super) fn common(&self, p: DVec3) -> DVec3 {
        self.proportions.common(p)
    }

    /// This head's size over the common one's.
    pub(super) fn size(&self) -> f64 {
        self.proportions.size()
    }

    /// How far hair stands off the head to pass over an ear: a smooth bump in its place.
    pub(super) fn over_ear(&self, p: DVec3) -> f64 {
        let ear = self.ears[usize::from(p.x < 0.0)];
        if ear.radii.x <= 0.0 {
            return 0.0;
        }
        let reach = ear.centre.x.abs() + ear.radii.x - self.proportions.half_breadth + 0.003;
        // Above the ear the bump runs out slowly, or hair would show a step.
        let up = if p.y > ear.centre.y { 2.5 } else { 1.7 };
        let along = if p.z > ear.centre.z { 2.4 } else { 3.6 };
        let (y, z) = (
            (p.y - ear.centre.y) / (up * ear.radii.y),
            (p.z - ear.centre.z) / (along * ear.radii.z),
        );
        let side = 0.62 * self.proportions.half_breadth;
        reach.max(0.0) * slope(side, 1.4 * side, p.x.abs()) * ops::exp(-y * y - z * z)
    }

    /// Whether a place lies in an ear or nearer to it than the margin.
    pub(super) fn in_ear(&self, p: DVec3) -> bool {
        self.ears.iter().any(|e| inside(e, p, EAR_MARGIN))
    }

    /// Moves a point out of the ears sideways.
    pub(super) fn beside_ear(&self, p: DVec3) -> DVec3 {
        let ear = &self.ears[usize::from(p.x < 0.0)];
        let r = ear.radii + DVec3::splat(EAR_MARGIN);
        let d = (p - ear.centre) / r;
        let rest = 1.0 - d.y * d.y - d.z * d.z;
        let sign = if p.x < 0.0 { -1.0 } else { 1.0 };
        if ear.radii.x <= 0.0 || rest <= 0.0 || d.x * sign > rest.sqrt() {
            return p;
        }
        p.with_x(ear.centre.x + sign * r.x * rest.sqrt())
    }

    /// Lifts a point to at least `height` above the skin, draws it to that height by the
    /// share `cling` of what it is above, and out of the body; also the skin's normal.
    pub(super) fn settle(&self, p: DVec3, height: f64, cling: f64) -> (DVec3, Option<DVec3>) {
        let (mut q, normal) = self.skin.settle(p, height, cling);
        if q.y < -0.3 * self.proportions.menton {
            let (d, n) = (self.body)(q);
            let margin = BODY_MARGIN + 0.3 * height;
            if d < margin {
                q += n * (margin - d).min(0.02);
            }
        }
        (q, normal)
    }
}

fn inside(ear: &Ear, p: DVec3, margin: f64) -> bool {
    ear.radii.x > 0.0
        && ((p - ear.centre) / (ear.radii + DVec3::splat(margin))).length_squared() < 1.0
}
