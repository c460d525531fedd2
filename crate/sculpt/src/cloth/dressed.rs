//! Dressed figure under construction, with the data shared by several garments.

use raconteur_base::DVec3;
use raconteur_body::figure::MaterialKind;
use raconteur_body::skeleton::Bone;

use super::finish::{Fabric, UnrollAxis, Unrolling, cloth_part};
use super::wearer::Wearer;
use crate::part::MeshPart;
use crate::torso::{CM, Shell};

/// Dressed body: meshes of clothes and shoes, and the cloth surface on which hair may rest.
#[derive(Clone, Debug)]
pub struct Dressed {
    /// Clothes and shoes, with one material for each kind of cloth.
    pub parts: Vec<MeshPart>,
    /// Cloth surface on which hair may rest.
    pub surface: Shell,
}

/// V-neckline of a cardigan: lower and upper end, and half its width.
pub(super) struct Neckline {
    pub(super) low: f64,
    pub(super) high: f64,
    half: f64,
}

impl Neckline {
    pub(super) fn for_wearer(wearer: &Wearer<'_>) -> Self {
        let unit = CM * wearer.scale;
        Self {
            low: wearer.joints.position_of(Bone::Thoracic).y + 2.5 * unit,
            high: wearer.joints.position_of(Bone::Cervical).y + 1.0 * unit,
            half: wearer.field.neck_radius() + 1.9 * unit,
        }
    }

    pub(super) fn half_width(&self, y: f64) -> f64 {
        let t = ((y - self.low) / (self.high - self.low)).clamp(0.0, 1.0);
        raconteur_base::ops::pow(t, 0.85) * self.half
    }
}

pub(super) fn cloth(kind: MaterialKind, dye: [f64; 3]) -> Fabric {
    Fabric { kind, dye }
}

pub(super) fn leather(dye: [f64; 3]) -> Fabric {
    cloth(MaterialKind::Leather, dye)
}

/// Names a part `collar`, for parts that lie against the neck.
pub(super) fn collar_part(part: MeshPart) -> MeshPart {
    MeshPart {
        name: "collar".to_owned(),
        ..part
    }
}

pub(super) fn trim(wearer: &Wearer<'_>, shell: &Shell, fabric: Fabric) -> MeshPart {
    let chart = [UnrollAxis {
        origin: DVec3::new(0.0, 1.2, -1.5 * CM),
        axis: DVec3::Y,
        front: DVec3::Z,
        radius: 14.0 * CM * wearer.scale,
    }];
    let unrolling = Unrolling {
        charts: &chart,
        chart_of: &|_| 0,
    };
    cloth_part("trim", shell, &[], wearer.field, fabric, unrolling)
}
