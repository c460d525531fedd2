//! Accessories of a head, made for its face.

mod cover;
mod glasses;
mod jewel;
mod solid;

use raconteur_base::DVec3;
use serde::Deserialize;

pub(super) use self::cover::Cover;
use self::solid::Solid;
use super::{NewFace, Reshaper, narrow, wide};
use raconteur_body::figure::{Figure, Material, MaterialKind, Mesh, TextureMaps};
use raconteur_body::skeleton::Bone;

/// Kind of accessory worn on the head: glasses, jewellery or head cover.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum AccessoryKind {
    /// Glasses with round rims.
    RoundGlasses,
    /// Glasses with square rims.
    SquareGlasses,
    /// Square glasses with dark lenses.
    Sunglasses,
    /// A small ball in each ear lobe.
    EarStuds,
    /// A ring in each ear lobe.
    EarRings,
    /// A small ball in the left wing of the nose.
    NoseStud,
    /// A knitted cap.
    KnittedCap,
    /// Felt hat with a brim.
    Hat,
    /// A cloth about head and neck, the face open.
    Headscarf,
}

/// Accessory worn on the head, with its kind and colour.
#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
pub struct Accessory {
    /// Kind of the accessory.
    pub kind: AccessoryKind,
    /// Linear red, green and blue, 0..1.
    pub colour: [f32; 3],
}

/// Vertices of the skin of our heads, by the names of Farkas 1994; the same in every head.
pub(super) mod landmark {
    /// Subaurale, left and right: the lowest points of the ear lobes.
    pub(in super::super) const SUBAURALE: [usize; 2] = [13_928, 13_942];
    /// Sellion: the deepest point of the bridge of the nose.
    pub(in super::super) const SELLION: usize = 1_239;
    /// Trichion: the hairline in the middle.
    pub(in super::super) const TRICHION: usize = 0;
    /// Gnathion: the lowest point of the chin.
    pub(in super::super) const GNATHION: usize = 5_874;
    /// Stomion: midpoint of the line where the lips meet.
    pub(in super::super) const STOMION: usize = 12_038;
}

/// Measures of the head that accessories are fitted to, in its frame, metres.
pub(super) struct Fit {
    skin: Vec<DVec3>,
    normals: Vec<DVec3>,
    eyes: [DVec3; 2],
    /// Origin of the head's frame in the world.
    origin: DVec3,
}

impl Fit {
    pub(super) fn new(reshaper: &Reshaper, figure: &Figure, face: &NewFace<'_>) -> Self {
        let head = figure.meshes.iter().find(|m| m.name == "head");
        let skin = head.map(|m| &m.positions[..reshaper.vertices.min(m.positions.len())]);
        let normals = head.map(|m| &m.normals[..reshaper.vertices.min(m.normals.len())]);
        let places = skin.unwrap_or_default().iter();
        Self {
            skin: places.map(|&p| wide(p) - reshaper.origin).collect(),
            normals: normals
                .unwrap_or_default()
                .iter()
                .map(|&n| wide(n))
                .collect(),
            eyes: face.organs.eye_centres,
            origin: reshaper.origin,
        }
    }

    /// Returns the position of a skin vertex; the origin if the head has too few.
    fn position(&self, vertex: usize) -> DVec3 {
        self.skin.get(vertex).copied().unwrap_or(DVec3::ZERO)
    }

    fn normal(&self, vertex: usize) -> DVec3 {
        self.normals.get(vertex).copied().unwrap_or(DVec3::Z)
    }

    /// Returns the frontmost z of the skin in a box around a position of the frontal plane, metres.
    fn front(&self, x: f64, y: f64, reach: f64) -> Option<f64> {
        let near = |p: &&DVec3| (p.x - x).abs() < reach && (p.y - y).abs() < reach && p.z > 0.0;
        let all = self.skin.iter().filter(near).map(|p| p.z);
        all.max_by(f64::total_cmp)
    }

    /// Returns the lateral extent of the skin in a box around a height and depth, metres.
    fn side(&self, sign: f64, y: f64, z: f64, reach: f64) -> Option<f64> {
        let near = |p: &&DVec3| (p.z - z).abs() < reach && (p.y - y).abs() < reach;
        let all = self.skin.iter().filter(near).map(|p| p.x * sign);
        all.max_by(f64::total_cmp)
    }

    /// Converts a solid in the head's frame to a mesh that follows the skull.
    fn mesh(&self, name: &str, solid: Solid, material: Material) -> Mesh {
        let count = solid.positions.len();
        let place = |p: &DVec3| narrow(*p + self.origin);
        Mesh {
            name: name.to_owned(),
            material,
            positions: solid.positions.iter().map(place).collect(),
            normals: solid.normals.iter().map(|&n| narrow(n)).collect(),
            uvs: solid.uvs,
            colors: vec![[255; 4]; count],
            joints: vec![[Bone::Skull.index() as u16, 0, 0, 0]; count],
            weights: vec![[1.0, 0.0, 0.0, 0.0]; count],
            indices: solid.indices,
            coarser: Vec::new(),
            morphs: Vec::new(),
            binding: None,
        }
    }
}

fn material(kind: MaterialKind, colour: [f32; 3], roughness: f32) -> Material {
    let part = |x: f32| {
        if x.is_finite() {
            x.clamp(0.0, 1.0)
        } else {
            0.5
        }
    };
    let [r, g, b] = colour.map(part);
    Material {
        kind,
        base_color: [r, g, b, 1.0],
        roughness,
        double_sided: true,
        maps: TextureMaps::default(),
    }
}

/// Returns the cover of an accessory; `None` if it does not cover the head.
pub(super) fn cover(kind: AccessoryKind, fit: &Fit) -> Option<Cover> {
    match kind {
        AccessoryKind::KnittedCap => Some(Cover::cap(fit)),
        AccessoryKind::Hat => Some(Cover::hat(fit)),
        AccessoryKind::Headscarf => Some(Cover::scarf(fit)),
        _ => None,
    }
}

/// Returns an accessory as meshes of the figure.
pub(super) fn meshes(worn: &Accessory, fit: &Fit) -> Vec<Mesh> {
    let Accessory { kind, colour } = *worn;
    if let Some(cover) = cover(kind, fit) {
        return cover.meshes(fit, colour);
    }
    match kind {
        AccessoryKind::RoundGlasses | AccessoryKind::SquareGlasses | AccessoryKind::Sunglasses => {
            glasses::meshes(kind, colour, fit)
        }
        _ => jewel::meshes(kind, colour, fit),
    }
}
