//! Garments of the upper body with set-in sleeves: close on the shoulders, loose over the waist,
//! gathered at the elbow and above cuff and hem.

use raconteur_base::curve::lerp;
use raconteur_base::{DVec3, Side, mirror_vector};

use super::band::{Band, BandPath, along_edge};
use super::cut::{ClothZone, Top, TopCut, mirrored_to};
use super::drape::{DrapeParams, Draping, drape};
use super::fade;
use super::finish::{Fabric, UnrollAxis, Unrolling, cloth_part};
use super::fold::{Fold, crease};
use super::gathers::folds;
use super::seam::{Stitch, sew};
use super::sheet::Sheet;
use super::strip::LayingSurface;
use super::wearer::Wearer;
use crate::part::MeshPart;
use crate::torso::cage::{HOLE, Key, RING, Tag};
use crate::torso::{CM, Cage, Field, Joints, Regions, Shell};
use raconteur_body::figure::MaterialKind;
use raconteur_body::skeleton::Bone;

/// Returns the distance of a point from the shoulder along the nearer arm, metres; negative inside
/// the trunk.
pub(super) fn along_arm(joints: &Joints, p: DVec3) -> f64 {
    let left = if p.x >= 0.0 { p } else { mirror_vector(p) };
    (left - joints.position_of(Bone::LShoulder)).dot(Joints::arm_axis())
}

fn arm_share(shell: &Shell) -> Vec<f64> {
    shell
        .weights
        .iter()
        .map(|w| Side::BOTH.iter().map(|s| w.arm(*s)).sum())
        .collect()
}

/// Cuts, settles and drapes a top on its wearer, outside the garments below it.
#[must_use]
pub fn top(wearer: &Wearer<'_>, cut: &TopCut, below: &Shell) -> Top {
    let (cage, joints) = (wearer.cage, wearer.joints);
    let unit = CM * wearer.scale;
    let rows = Cage::row_at(cut.reach[0])..Cage::row_at(cut.reach[1]);
    let last_span = Cage::arm_ring_at(1.80);
    let mut sheet = Sheet::extract(cage, |tag| match tag {
        Tag::Trunk(r) => rows.contains(&r),
        Tag::Arm(j) => j <= last_span,
        Tag::Leg(_) => false,
    });
    let form = wearer.field.dress_form(cut.straight);
    let (low, high) = (
        cage.row_height(Cage::row_at(0.735)),
        cage.row_height(HOLE.1),
    );
    let neck = |p: DVec3| fade(p.y, high, high + 4.0 * unit);
    sheet.settle(
        &form,
        Regions::ALL,
        |p| lerp(1.25, 1.0, neck(p)),
        |p| {
            let along = along_arm(joints, p);
            let on_arm = fade(along, 4.0 * unit, 14.0 * unit);
            let trunk = lerp(cut.ease_cm[1], cut.ease_cm[0], fade(p.y, low, high));
            unit * lerp(
                lerp(trunk, cut.sleeve_ease_cm, on_arm),
                cut.ease_cm[0] * 0.75,
                neck(p),
            )
        },
    );
    let mut out = Top {
        neck: Vec::new(),
        hem: Vec::new(),
        cuffs: Vec::new(),
        sheet,
    };
    out.find_edges();
    let mut cloth = prepare(&out, wearer, cut);
    let waist = cage.row_height(Cage::row_at(0.635));
    let thickness = |p: DVec3| {
        let below = if along_arm(joints, p) < 0.0 || p.y < waist - 0.1 {
            fade(p.y, waist, waist - 5.0 * unit)
        } else {
            0.0
        };
        unit * (0.5 + lerp(cut.over_cm[0], cut.over_cm[1], below))
    };
    let params = DrapeParams {
        seed: cut.seed,
        ..DrapeParams::default()
    };
    drape(&mut cloth, &params, wearer.field, &thickness);
    out.sheet.shell = cloth.shell;
    out.sheet.shell.relax(1);
    if cut.is_taut {
        bridge_chest(&mut out.sheet.shell, wearer);
    }
    let lay = LayingSurface::new(below);
    for _ in 0..2 {
        clear(&mut out.sheet.shell, &lay, 0.55 * unit);
    }
    push_outside(&mut out.sheet.shell, wearer.field, 0.2 * unit);
    out
}

/// Range of cage rows in which cloth is taut over the chest. Chosen by eye.
const TAUT: (f64, f64) = (0.675, 0.815);
const TAUT_ROUNDS: usize = 40;

/// Spans the hollows of a chest, around its muscles and under the collar bones, so that cloth does
/// not sink into them.
fn bridge_chest(shell: &mut Shell, wearer: &Wearer<'_>) {
    let unit = CM * wearer.scale;
    let [low, high] = [TAUT.0, TAUT.1].map(|at| wearer.cage.row_height(Cage::row_at(at)));
    let shares: Vec<f64> = shell
        .points
        .iter()
        .zip(arm_share(shell))
        .map(|(p, arm)| {
            let body = fade(arm, 0.35, 0.05);
            body * fade(p.y, low, low + 4.0 * unit) * fade(p.y, high + 3.0 * unit, high)
        })
        .collect();
    let outward: Vec<DVec3> = shell
        .points
        .iter()
        .map(|p| wearer.field.value_and_normal(*p, Regions::ALL, 1.0).1)
        .collect();
    shell.bridge(TAUT_ROUNDS, &shares, &outward);
}

/// Moves points that relaxation pulled into the body, such as in the armpit's crease, back outside.
fn push_outside(shell: &mut Shell, body: &Field, off: f64) {
    for _ in 0..6 {
        for p in &mut shell.points {
            let (d, n) = body.value_and_normal(*p, Regions::ALL, 1.0);
            *p += n * (off - d).clamp(0.0, CM);
        }
    }
}

/// Pushes the trunk's cloth out of the garments below it.
fn clear(shell: &mut Shell, below: &LayingSurface<'_>, off: f64) {
    let high = below.top() + 0.02;
    let arm = arm_share(shell);
    for (p, arm) in shell.points.iter_mut().zip(arm) {
        if arm < 0.5 && p.y < high {
            *p = below.pushed_outside(*p, off);
        }
    }
}

impl Top {
    /// Finds neck, hem and cuffs again after faces were removed.
    pub fn find_edges(&mut self) {
        let shell = &self.sheet.shell;
        let arm = arm_share(shell);
        let mean = |ring: &[u32], f: &dyn Fn(usize) -> f64| {
            ring.iter().map(|&v| f(v as usize)).sum::<f64>() / ring.len() as f64
        };
        let (cuffs, mut trunk): (Vec<_>, Vec<_>) = shell
            .loops()
            .into_iter()
            .partition(|ring| mean(ring, &|v| arm[v]) > 0.5);
        trunk.sort_by(|a, b| {
            mean(a, &|v| shell.points[v].y).total_cmp(&mean(b, &|v| shell.points[v].y))
        });
        self.neck = trunk.last().cloned().unwrap_or_default();
        self.hem = trunk.first().cloned().unwrap_or_default();
        self.cuffs = cuffs;
    }

    /// Sews the seams of armholes, sides, under the arms and, optionally, over the shoulders.
    pub fn sew(&mut self, wearer: &Wearer<'_>) {
        let unit = CM * wearer.scale;
        let mut lines = Vec::new();
        for side in Side::BOTH {
            let column = |q: usize| {
                if side == Side::Left { q } else { (24 - q) % 24 }
            };
            // Set in at the shoulder's corner, a ring outside the cage's armhole.
            let ring = (0..=RING).map(|k| Key::Arm(side, 0, k % RING));
            lines.push(self.sheet.line(ring));
            // The side seam continues below the sleeve.
            let side_seam = (0..=HOLE.0).map(|r| Key::Trunk(r, column(6)));
            let sleeve = (0..=Cage::arm_ring_at(2.0)).map(|j| Key::Arm(side, j, RING / 2));
            lines.push(self.sheet.line(side_seam.chain(sleeve)));
        }
        let stitch = Stitch {
            reach: 0.38 * unit,
            depth: 0.13 * unit,
            swell: 0.05 * unit,
        };
        sew(&mut self.sheet, &lines, stitch);
    }

    /// Converts the cloth of the garment to a drawable mesh part.
    #[must_use]
    pub fn to_part(&self, wearer: &Wearer<'_>, cut: &TopCut) -> MeshPart {
        let charts = charts(wearer);
        let shell = &self.sheet.shell;
        let chart_of = |f: usize| match self.sheet.tags[f] {
            Tag::Trunk(_) => 0,
            Tag::Arm(_) | Tag::Leg(_) => {
                let x: f64 = shell.faces[f]
                    .iter()
                    .map(|&v| shell.points[v as usize].x)
                    .sum();
                if x > 0.0 { 1 } else { 2 }
            }
        };
        let unrolling = Unrolling {
            charts: &charts,
            chart_of: &chart_of,
        };
        cloth_part(
            cut.name,
            shell,
            &self.sheet.shade,
            wearer.field,
            cut.fabric,
            unrolling,
        )
    }

    /// Returns the height of the lowest point of the hem, metres.
    pub(super) fn lowest_of_hem(&self) -> f64 {
        self.hem
            .iter()
            .map(|&v| self.sheet.shell.points[v as usize].y)
            .fold(f64::MAX, f64::min)
    }

    /// Builds a band along the edge of the neck, the hem or a cuff, with its surface. Chart 0 is
    /// the chart of the trunk.
    #[must_use]
    pub fn band(
        &self,
        wearer: &Wearer<'_>,
        ring: &[u32],
        band: &Band<'_>,
        fabric: Fabric,
    ) -> (MeshPart, Shell) {
        let shell = along_edge(&self.sheet.shell, ring, band);
        let charts = charts(wearer);
        let chart = if matches!(band.round, BandPath::Body(_, Regions::UPPER)) {
            let first = ring
                .first()
                .map_or(0.0, |&v| self.sheet.shell.points[v as usize].x);
            if first > 0.0 { 1 } else { 2 }
        } else {
            0
        };
        let unrolling = Unrolling {
            charts: &charts,
            chart_of: &|_| chart,
        };
        let part = cloth_part("band", &shell, &[], wearer.field, fabric, unrolling);
        (part, shell)
    }

    /// Builds ribbed bands at the hem and the wrists; widths in centimetres on a body of 175 cm.
    #[must_use]
    pub fn rib_bands(
        &self,
        wearer: &Wearer<'_>,
        fabric: Fabric,
        [hem_cm, cuff_cm]: [f64; 2],
        [hem_ease_cm, cuff_ease_cm]: [f64; 2],
        below: &Shell,
    ) -> Vec<(MeshPart, Shell)> {
        let unit = CM * wearer.scale;
        let rib = fabric.woven(MaterialKind::Rib);
        let hem = Band {
            direction: DVec3::NEG_Y,
            width: hem_cm * unit,
            thickness: 0.3 * unit,
            ease: hem_ease_cm * unit,
            round: BandPath::Body(wearer.field, Regions::LOWER),
            billow: 0.0,
            every: 1,
        };
        let (mut part, mut shell) = self.band(wearer, &self.hem, &hem, rib);
        let lay = LayingSurface::new(below);
        for v in &mut part.vertices {
            v.position = lay.pushed_outside(v.position, 0.3 * unit);
        }
        for p in &mut shell.points {
            *p = lay.pushed_outside(*p, 0.3 * unit);
        }
        let mut out = vec![(part, shell)];
        for cuff in &self.cuffs {
            let first = cuff
                .first()
                .map_or(0.0, |&v| self.sheet.shell.points[v as usize].x);
            let side = if first > 0.0 { Side::Left } else { Side::Right };
            let band = Band {
                direction: mirrored_to(side, Joints::arm_axis()),
                width: cuff_cm * unit,
                thickness: 0.25 * unit,
                ease: cuff_ease_cm * unit,
                round: BandPath::Body(wearer.field, Regions::UPPER),
                billow: 0.0,
                every: 1,
            };
            out.push(self.band(wearer, cuff, &band, rib));
        }
        out
    }
}

/// Charts of trunk, left sleeve and right sleeve.
fn charts(wearer: &Wearer<'_>) -> [UnrollAxis; 3] {
    let joints = wearer.joints;
    let sleeve = |side: Side| UnrollAxis {
        origin: mirrored_to(side, joints.position_of(Bone::LShoulder)),
        axis: -mirrored_to(side, Joints::arm_axis()),
        front: mirrored_to(side, Joints::arm_up()),
        radius: 5.5 * CM * wearer.scale,
    };
    let trunk = UnrollAxis {
        // Coordinates within ±1 m store small.
        origin: DVec3::new(0.0, 1.2, -1.5 * CM),
        axis: DVec3::Y,
        front: DVec3::Z,
        radius: 14.0 * CM * wearer.scale,
    };
    [trunk, sleeve(Side::Left), sleeve(Side::Right)]
}

/// Returns the zone of the cloth of each point.
fn zones(shell: &Shell, on_arm: &[f64]) -> Vec<Option<ClothZone>> {
    shell
        .weights
        .iter()
        .zip(on_arm)
        .map(|(w, arm)| {
            if *arm < 0.5 {
                Some(ClothZone::Trunk)
            } else {
                Side::BOTH
                    .into_iter()
                    .find(|s| w.arm(*s) >= 0.5)
                    .map(ClothZone::Sleeve)
            }
        })
        .collect()
}

/// Pins, rest lengths, folds and the tightened cuffs and hem.
fn prepare(top: &Top, wearer: &Wearer<'_>, cut: &TopCut) -> Draping {
    let (field, cage, joints) = (wearer.field, wearer.cage, wearer.joints);
    let unit = CM * wearer.scale;
    let mut shell = top.sheet.shell.clone();
    let on_arm = arm_share(&shell);
    let along: Vec<f64> = shell
        .points
        .iter()
        .zip(&on_arm)
        .map(|(p, arm)| {
            if *arm > 0.5 {
                along_arm(joints, *p)
            } else {
                0.0
            }
        })
        .collect();
    let shoulder = joints.position_of(Bone::LShoulder);
    let upper_arm = joints.position_of(Bone::LElbow).distance(shoulder);
    let end = along.iter().copied().fold(0.0, f64::max) - 0.3 * unit;
    let start = end - 4.0 * unit;
    let yoke = cage.row_height(HOLE.0 + 2);
    let mut pin = vec![0.0; shell.points.len()];
    for v in 0..pin.len() {
        let p = shell.points[v];
        // The cuff sits close.
        let (d, n) = field.value_and_normal(p, Regions::ALL, 1.0);
        shell.points[v] -= n * (d - 0.7 * unit).clamp(0.0, 5.0 * CM) * fade(along[v], start, end);
        let near_neck = fade(p.y, shoulder.y + 2.0 * unit, shoulder.y + 5.0 * unit)
            * f64::from(u8::from(p.x.abs() < shoulder.x));
        // Yoke and sleeve cap are tailored, not draped: excess there would puff.
        let hold = if on_arm[v] > 0.5 {
            fade(along[v] / upper_arm, 0.62, 0.37)
        } else {
            fade(p.y, yoke - 4.0 * unit, yoke + 3.0 * unit)
        };
        pin[v] = near_neck
            .max(fade(along[v], start + unit, end))
            .max(0.985 * hold);
    }
    for &v in top.neck.iter().chain(top.cuffs.iter().flatten()) {
        pin[v as usize] = 1.0;
    }
    for &v in &top.hem {
        pin[v as usize] = 0.9;
    }
    hold_hem_in(&mut shell, top, &on_arm, unit);
    let folds = folds(top, wearer, cut);
    let normals = shell.normals();
    let place = zones(&shell, &on_arm);
    let strokes: Vec<Fold> = folds.iter().map(|f| f.1).collect();
    crease(&mut shell.points, &normals, &strokes, |f, v| {
        place[v] == Some(folds[f].0) && pin[v] < 0.99
    });
    // Excess length along the sleeves and down the trunk must turn into folds.
    let top_y = joints.position_of(Bone::Cervical).y - 20.0 * unit;
    let rest = (0..shell.points.len())
        .map(|v| {
            let p = shell.points[v];
            let mut q = p;
            for side in Side::BOTH {
                let axis = mirrored_to(side, Joints::arm_axis());
                let excess = (along[v] - 0.45 * upper_arm).max(0.0) * cut.slack;
                q += axis * excess * fade(shell.weights[v].arm(side), 0.3, 0.9);
            }
            if on_arm[v] < 0.01 {
                q.y -= 0.02 * (top_y - p.y).clamp(0.0, 60.0 * CM);
            }
            q
        })
        .collect();
    Draping { shell, rest, pin }
}

/// Pulls the bottom edge in by ribbing.
fn hold_hem_in(shell: &mut Shell, top: &Top, on_arm: &[f64], unit: f64) {
    let at = |v: &u32| shell.points[*v as usize];
    let centre = top.hem.iter().map(at).sum::<DVec3>() / top.hem.len().max(1) as f64;
    let high = top.hem.iter().map(|v| at(v).y).fold(f64::MIN, f64::max);
    for (p, arm) in shell.points.iter_mut().zip(on_arm) {
        if *arm < 0.3 {
            let k = fade(p.y, high + 4.0 * unit, high) * 0.035;
            *p = DVec3::new(lerp(p.x, centre.x, k), p.y, lerp(p.z, centre.z, k));
        }
    }
}

/// Returns the neckline's direction: up and slightly forward, along the neck.
#[must_use]
pub fn up_the_neck() -> DVec3 {
    DVec3::new(0.0, 1.0, 0.25).normalize()
}

/// Removes the faces whose centre `inside` accepts, and moves the new edge onto the line: `edge`
/// gives the half width at a height.
pub fn open_front(
    top: &mut Top,
    field: &Field,
    inside: impl Fn(DVec3) -> bool,
    edge: impl Fn(f64) -> Option<f64>,
) {
    top.sheet.retain(|shell, f| {
        let face = &shell.faces[f];
        let middle = face
            .iter()
            .map(|&v| shell.points[v as usize])
            .sum::<DVec3>()
            / face.len() as f64;
        !inside(middle)
    });
    top.find_edges();
    let rim = top.neck.clone();
    for v in rim {
        let p = &mut top.sheet.shell.points[v as usize];
        if p.z < 0.0 {
            continue;
        }
        if let Some(half) = edge(p.y) {
            let off = field.value_and_normal(*p, Regions::ALL, 1.0).0;
            p.x = half * if p.x < 0.0 { -1.0 } else { 1.0 };
            for _ in 0..3 {
                let (d, n) = field.value_and_normal(*p, Regions::ALL, 1.0);
                *p += DVec3::new(0.0, n.y, n.z) * (off - d).clamp(-2.0 * CM, 2.0 * CM);
            }
        }
    }
}
