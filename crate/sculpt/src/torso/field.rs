//! Body as an implicit surface: lofts and ellipsoids joined by a smooth minimum.
//!
//! Values approximate signed distance in metres, negative inside. The field is symmetric and
//! evaluated with |x|, so thighs never fuse. Smooth minimum: Quílez's polynomial form.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec2, DVec3, ops};

use super::section::Sections;
use super::shape::{BodyParams, CM, Joints};
use raconteur_body::skeleton::Bone;

/// Set of body regions that an evaluation of a [`Field`] includes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Regions(u8);

impl Regions {
    const TRUNK: u8 = 1;
    const ARM: u8 = 2;
    const LEG: u8 = 4;
    const NECK: u8 = 8;
    /// Set of all regions: the whole body.
    pub const ALL: Self = Self(15);
    /// Set of trunk, neck and arms.
    pub const UPPER: Self = Self(Self::TRUNK | Self::ARM | Self::NECK);
    /// Set of trunk and legs.
    pub const LOWER: Self = Self(Self::TRUNK | Self::LEG);

    /// Set of the trunk only.
    pub const TRUNK_ONLY: Self = Self(Self::TRUNK);
    /// Set of the legs only.
    pub const LEG_ONLY: Self = Self(Self::LEG);

    fn has(self, bit: u8) -> bool {
        self.0 & bit != 0
    }
}

/// A muscle or pad.
#[derive(Clone, Copy, Debug)]
struct Pad {
    centre: DVec3,
    radii: DVec3,
    /// Width of the blend, metres.
    blend: f64,
    /// Required regions, any of them.
    regions: u8,
    /// Rotation about z of the pad's frame, as (cos, sin).
    turn: (f64, f64),
}

/// Straight limb of two segments with cross-sections along its axis; solid of the body's distance
/// field.
#[derive(Clone, Debug)]
pub(super) struct Limb {
    pub(super) origin: DVec3,
    pub(super) axis: DVec3,
    pub(super) up: DVec3,
    side: DVec3,
    pub(super) lengths: [f64; 2],
    pub(super) sections: Sections,
}

impl Limb {
    fn new(origin: DVec3, axis: DVec3, up: DVec3, lengths: [f64; 2], sections: Sections) -> Self {
        let mut side = axis.cross(up);
        if side.z < 0.0 {
            side = -side;
        }
        Self {
            origin,
            axis,
            up,
            side,
            lengths,
            sections,
        }
    }

    /// Converts a distance along the axis, metres, to the parameter of the limb: 0 root, 1 middle
    /// joint, 2 end.
    pub(super) fn parameter(&self, along_m: f64) -> f64 {
        if along_m < self.lengths[0] {
            along_m / self.lengths[0]
        } else {
            1.0 + (along_m - self.lengths[0]) / self.lengths[1]
        }
    }

    /// Converts the parameter of the limb to the distance along its axis, metres.
    pub(super) fn along(&self, t: f64) -> f64 {
        if t < 1.0 {
            t * self.lengths[0]
        } else {
            self.lengths[0] + (t - 1.0) * self.lengths[1]
        }
    }

    fn distance(&self, p: DVec3) -> f64 {
        let d = p - self.origin;
        let t = self.parameter(d.dot(self.axis));
        let [up, down, front, back, _] = self.sections.sample(t);
        let a = d.dot(self.up) + 1e-6;
        let b = d.dot(self.side);
        let rho = (a * a + b * b).sqrt() + 1e-11;
        let ra = if a > 0.0 { up } else { down } * CM;
        let rb = if b > 0.0 { front } else { back } * CM;
        let radius = superellipse(a / rho / ra, b / rho / rb, 2.15);
        let beyond = if t < self.sections.first() {
            (self.sections.first() - t) * self.lengths[0]
        } else if t > self.sections.last() {
            (t - self.sections.last()) * self.lengths[1]
        } else {
            0.0
        };
        let mut out = rho - radius;
        if beyond > 0.0 {
            let outside = out.max(0.0);
            out = (outside * outside + beyond * beyond).sqrt() + out.min(0.0) * 0.2;
        }
        out * 0.92
    }
}

/// Returns the radius of a superellipse of exponent n in a direction scaled by its radii.
fn superellipse(a: f64, b: f64, n: f64) -> f64 {
    ops::pow(ops::pow(a.abs(), n) + ops::pow(b.abs(), n), -1.0 / n)
}

fn smooth_min(a: f64, b: f64, k: f64) -> f64 {
    let h = (k - (a - b).abs()).max(0.0) / k;
    a.min(b) - h * h * k * 0.25
}

/// Axis and radii of the neck in the body's distance field.
#[derive(Clone, Copy, Debug)]
pub(super) struct Neck {
    pub(super) bottom_y: f64,
    pub(super) top_y: f64,
    bottom_z: f64,
    top_z: f64,
    pub(super) radius: f64,
    /// Half the depth of the neck divided by its lateral radius: men's necks are deep.
    depth: f64,
}

impl Neck {
    /// Returns the z coordinate of the neck's centre at a height, metres.
    pub(super) fn centre_z(&self, y: f64) -> f64 {
        lerp(self.bottom_z, self.top_z, self.share(y))
    }

    fn share(&self, y: f64) -> f64 {
        (y - self.bottom_y) / (self.top_y - self.bottom_y)
    }
}

/// Distance field of one body, from which its skin and its clothes are shaped.
#[derive(Clone, Debug)]
pub struct Field {
    pub(super) stature_m: f64,
    /// 1 for the proportions of a child.
    pub(super) child: f64,
    pub(super) trunk: Sections,
    pub(super) neck: Neck,
    pub(super) arm: Limb,
    pub(super) leg: Limb,
    pads: Vec<Pad>,
}

impl Field {
    /// Creates the field from the measures and joints of a body.
    #[must_use]
    pub fn new(p: &BodyParams, joints: &Joints) -> Self {
        let s = p.stature_m;
        let k = p.scale();
        let child = p.child();
        // Age thins the limbs.
        let wide = (1.0 + 0.10 * p.build) * (1.0 - 0.05 * p.old());
        let trunk_scale = s / lerp(1.75, 1.65, p.sex);
        let trunk = Sections::trunk(p);
        let shoulder = joints.position_of(Bone::LShoulder);
        let span = |a: Bone, b: Bone| joints.position_of(a).distance(joints.position_of(b));
        let arm = Limb::new(
            shoulder,
            Joints::arm_axis(),
            Joints::arm_up(),
            [
                span(Bone::LShoulder, Bone::LElbow),
                span(Bone::LElbow, Bone::LWrist),
            ],
            Sections::arm(lerp(k * lerp(1.0, 0.86, p.sex), s / 1.33 * 0.635, child) * wide),
        );
        let hip = joints.position_of(Bone::LHip);
        let leg_axis = (joints.position_of(Bone::LSubtalar) - hip).normalize();
        let leg_out = (DVec3::X - leg_axis * leg_axis.x).normalize();
        let leg = Limb::new(
            hip,
            leg_axis,
            leg_out,
            [
                span(Bone::LHip, Bone::LKnee),
                span(Bone::LKnee, Bone::LSubtalar),
            ],
            Sections::leg(lerp(k * lerp(1.035, 1.065, p.sex), s / 1.33 * 0.70, child) * wide),
        );
        let adult = lerp(6.35 * k, 4.95 * s / 1.65, p.sex) * (1.0 - 0.04 * p.old());
        let radius = lerp(adult, 4.5 * s / 1.33, child) * CM;
        let (bottom_y, top_y) = (
            joints.position_of(Bone::Cervical).y - CM,
            joints.position_of(Bone::Skull).y,
        );
        let neck = Neck {
            bottom_y,
            top_y,
            bottom_z: -3.0 * trunk_scale * lerp(1.0, 0.7, child) * CM + p.stoop_m(bottom_y),
            top_z: p.stoop_m(top_y),
            radius,
            depth: lerp(lerp(1.17, 1.06, p.sex), 1.06, child),
        };
        let pads = pads(p, shoulder, trunk.sample(lerp(0.713, 0.693, child))[1]);
        Self {
            stature_m: s,
            child,
            trunk,
            neck,
            arm,
            leg,
            pads,
        }
    }

    /// Returns the form on which cloth hangs: the same body with the hollow of the waist partly
    /// filled; `share` 0 leaves it, 1 lets the cloth fall straight from chest to hip.
    #[must_use]
    pub fn dress_form(&self, share: f64) -> Self {
        let shift = -0.02 * self.child;
        Self {
            trunk: self.trunk.bridged(0.515 + shift, 0.735 + shift, share),
            ..self.clone()
        }
    }

    /// Returns the lateral radius of the neck, metres.
    #[must_use]
    pub fn neck_radius(&self) -> f64 {
        self.neck.radius
    }

    /// Returns the point `off` metres outside the neck's own surface, at a height and at an angle
    /// from the front towards the left.
    #[must_use]
    pub fn neck_point(&self, angle_rad: f64, y: f64, off: f64) -> DVec3 {
        let n = &self.neck;
        let (s, c) = ops::sincos(angle_rad);
        let out = DVec3::new(s * (n.radius + off), 0.0, c * (n.radius * n.depth + off));
        self.neck_centre(y) + out
    }

    /// Returns the centre of the neck at a height, world, metres.
    #[must_use]
    pub fn neck_centre(&self, y: f64) -> DVec3 {
        let n = &self.neck;
        let share = n.share(y).clamp(-0.3, 1.6);
        DVec3::new(0.0, y, lerp(n.bottom_z, n.top_z, share))
    }

    /// Returns the approximate signed distance of a point from the selected regions, metres;
    /// negative inside.
    #[must_use]
    pub fn value(&self, p: DVec3, regions: Regions, soften: f64) -> f64 {
        let p = DVec3::new(p.x.abs() + 1e-6, p.y, p.z);
        let mut d = 10.0;
        if regions.has(Regions::TRUNK) {
            d = self.trunk_distance(p);
        }
        if regions.has(Regions::NECK) {
            d = smooth_min(d, self.neck_distance(p), 4.0 * CM * soften);
        }
        if regions.has(Regions::LEG) {
            d = smooth_min(d, self.leg.distance(p), 3.5 * CM * soften);
        }
        if regions.has(Regions::ARM) {
            d = smooth_min(d, self.arm.distance(p), 4.0 * CM * soften);
        }
        for pad in self.pads.iter().filter(|pad| regions.0 & pad.regions != 0) {
            let q = p - pad.centre;
            let (c, s) = pad.turn;
            let q = DVec3::new(q.x * c + q.y * s, -q.x * s + q.y * c, q.z);
            let k0 = (q / pad.radii).length();
            let k1 = (q / (pad.radii * pad.radii)).length() + 1e-9;
            d = smooth_min(d, k0 * (k0 - 1.0) / k1, pad.blend * soften);
        }
        d
    }

    fn trunk_distance(&self, p: DVec3) -> f64 {
        let [half, front, back, centre, n] = self.trunk.sample(p.y / self.stature_m);
        let q = DVec2::new(p.x, p.z - centre * CM);
        let rho = q.length() + 1e-11;
        let depth = if q.y > 0.0 { front } else { back } * CM;
        let d = (rho - superellipse(q.x / rho / (half * CM), q.y / rho / depth, n)) * 0.9;
        let (low, high) = (
            self.trunk.first() * self.stature_m,
            self.trunk.last() * self.stature_m,
        );
        let beyond = (low - p.y).max(p.y - high);
        if beyond > 0.0 {
            let outside = d.max(0.0);
            (outside * outside + beyond * beyond).sqrt()
        } else {
            d
        }
    }

    fn neck_distance(&self, p: DVec3) -> f64 {
        let n = &self.neck;
        let t = n.share(p.y).clamp(-0.3, 1.6);
        let z = p.z - lerp(n.bottom_z, n.top_z, t);
        let r = DVec2::new(p.x / n.radius, z / (n.radius * n.depth)).length();
        let side = (r - 1.0) * n.radius * 0.95;
        let below = n.bottom_y - 0.3 * (n.top_y - n.bottom_y) - p.y;
        if below > 0.0 { side.max(below) } else { side }
    }

    /// Returns the value and the outward unit normal; the value is divided by the gradient's
    /// length.
    #[must_use]
    pub fn value_and_normal(&self, p: DVec3, regions: Regions, soften: f64) -> (f64, DVec3) {
        const E: f64 = 5e-4;
        let d = self.value(p, regions, soften);
        let at = |offset: DVec3| self.value(p + offset, regions, soften) - d;
        // To both sides across, or the halves would differ by the difference's error.
        let across = (at(DVec3::X * E) - at(DVec3::NEG_X * E)) / 2.0;
        let g = DVec3::new(across, at(DVec3::Y * E), at(DVec3::Z * E));
        let length = g.length().max(1e-4 * E);
        (d / (length / E).max(0.35), g / length)
    }
}

/// Muscles and pads of the left side.
#[expect(clippy::too_many_lines, reason = "a table: one row for each pad")]
fn pads(p: &BodyParams, shoulder: DVec3, chest_front_cm: f64) -> Vec<Pad> {
    let (s, f, child, old) = (p.stature_m, p.sex, p.child(), p.old());
    let k = p.scale() * lerp(1.0, 0.9, child);
    let m = lerp(lerp(1.0, 0.72, f), 0.55, child) * (1.0 + 0.1 * p.build) * (1.0 - 0.12 * old);
    let mut out = Vec::new();
    let mut add = |centre: DVec3, radii_cm: DVec3, blend_cm: f64, regions: u8, turn_deg: f64| {
        let a = turn_deg.to_radians();
        out.push(Pad {
            centre,
            radii: radii_cm * CM,
            blend: blend_cm * CM,
            regions,
            turn: (ops::cos(a), ops::sin(a)),
        });
    };
    let trunk = Regions::TRUNK;
    let height = |adult: f64, boy: f64| lerp(adult, boy, child) * s;
    // Depths refer to an upright back.
    let v = |x: f64, y: f64, z: f64| DVec3::new(x, y, z + p.stoop_m(y));
    let r = DVec3::new;
    // The deltoid is long and flat, because the shoulder would otherwise look inflated.
    let deltoid = r(4.1, 6.8, 5.2) * k * lerp(lerp(1.0, 0.78, f), 0.84, child);
    add(
        shoulder + r(lerp(0.5, 0.3, f), -2.2, 0.1) * k * CM,
        deltoid * (1.0 - 0.06 * old),
        3.6 * k,
        trunk | Regions::ARM,
        -30.0,
    );
    // Acromion: the corner where the slope of the neck ends.
    add(
        shoulder + r(-0.3, lerp(3.6, 3.0, f), -0.4) * k * CM,
        r(2.6, 1.0, 2.2) * k * lerp(lerp(1.0, 0.86, f), 0.85, child),
        2.6 * k,
        trunk | Regions::ARM,
        -16.0,
    );
    // Pectoral, scapula, trapezius, clavicle, gluteus.
    let chest = v(
        shoulder.x * 0.52,
        height(0.742, 0.715),
        (chest_front_cm - 3.2 * k) * CM,
    );
    let chest = DVec3::new(chest.x, chest.y, chest.z - p.stoop_m(chest.y));
    add(chest, r(8.0, 5.2, 3.6) * k * m, 3.0 * k, trunk, 15.0);
    let blade = v(
        shoulder.x * 0.55,
        height(0.755, 0.73),
        -9.2 * k * lerp(1.0, 0.85, f) * CM,
    );
    add(
        blade,
        r(6.0, 8.0, 2.9) * k * lerp(m, 0.7, 0.3 * child),
        4.0 * k,
        trunk,
        12.0,
    );
    add(
        v(shoulder.x * 0.42, height(0.824, 0.797), -3.6 * k * CM),
        r(7.8, 2.7, 3.6) * k * lerp(m, 0.8, 0.35 * child),
        4.0 * k,
        trunk,
        -24.0,
    );
    add(
        v(shoulder.x * 0.5, height(0.808, 0.782), 2.2 * k * CM),
        r(8.5, 1.0, 1.2) * k,
        2.4 * k,
        trunk,
        -4.0,
    );
    let seat = lerp(lerp(1.0, 1.06, f), 0.70, child) * (1.0 - 0.06 * old);
    add(
        DVec3::new(
            7.4 * k * seat * CM,
            height(0.500, 0.482),
            -6.6 * k * seat * CM,
        ),
        r(7.2, 8.0, 6.2) * k * seat * (1.0 + 0.08 * p.build),
        3.5 * k,
        trunk | Regions::LEG,
        0.0,
    );
    let bust = 6.8 * k * p.bust * f * (1.0 - child);
    if bust > 1.0 {
        add(
            v(7.6 * k * CM, s * 0.722, 5.4 * k * CM),
            r(bust * 0.98, bust, bust),
            3.0 * k,
            trunk,
            0.0,
        );
        add(
            v(7.0 * k * CM, s * 0.748, 4.6 * k * CM),
            r(bust * 0.9, bust * 0.9, bust * 0.75),
            4.0 * k,
            trunk,
            0.0,
        );
    }
    out
}
