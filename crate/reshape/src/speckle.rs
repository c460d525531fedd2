//! Freckles, age spots, moles and stubble: small spots of a face, finer than its vertices. Each
//! seed has its own positions; shaved hair is the same on all faces.

use raconteur_base::curve::smooth;
use raconteur_base::{DVec3, noise};

use super::accessory::landmark;
use super::surface_point::{Chart, SurfacePoint};
use super::{Reshaper, wide};
use raconteur_body::figure::Figure;

/// Kind of small skin mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SpeckleKind {
    /// Freckles, mostly on nose and cheeks.
    Freckles,
    /// Stubble of a shaved beard.
    Stubble,
    /// Age spots, on skin exposed to the sun: temples, forehead, cheekbones.
    AgeSpots,
    /// A few, anywhere.
    Moles,
}

/// Small skin mark, such as a freckle or mole, with its position on the skin texture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Speckle {
    /// Chart of its position on the skin texture.
    pub chart: Chart,
    /// Strength of the mark, 0..1.
    pub strength: f64,
}

impl SpeckleKind {
    /// Returns the number of candidate positions.
    fn tried(self) -> i64 {
        match self {
            Self::Freckles => 9_000,
            Self::Stubble => 26_000,
            Self::AgeSpots => 400,
            Self::Moles => 40,
        }
    }

    /// Returns the random stream that separates this kind from the others of a seed.
    fn stream(self, seed: u64) -> u64 {
        let own = if self == Self::Stubble { 0 } else { seed };
        0x5bec ^ self as u64 ^ own.wrapping_mul(0x9e37_79b9_7f4a_7c15)
    }
}

/// Landmarks of the face on which skin marks are placed, in the frame of the head, metres.
pub(super) struct FacePoints {
    sellion: DVec3,
    stomion: DVec3,
    gnathion: DVec3,
    /// The lobe of an ear, outwards and up.
    lobe: DVec3,
}

impl FacePoints {
    /// Derives the landmarks from a skin with the origin of the head's frame at `origin`.
    pub(super) fn from_skin(skin: &[[f32; 3]], origin: DVec3) -> Option<Self> {
        let at = |v: usize| skin.get(v).map(|&p| wide(p) - origin);
        let lobe = at(landmark::SUBAURALE[0])?;
        Some(Self {
            sellion: at(landmark::SELLION)?,
            stomion: at(landmark::STOMION)?,
            gnathion: at(landmark::GNATHION)?,
            lobe: lobe.with_x(lobe.x.abs()),
        })
    }

    /// Returns the likelihood of a freckle: highest across the nose and the cheekbones, some on
    /// forehead and chin.
    fn freckles(&self, p: DVec3) -> f64 {
        let height = self.sellion.y - self.stomion.y;
        let up = (p.y - self.stomion.y) / height;
        let aside = p.x.abs() / self.lobe.x.max(0.03);
        let front = smooth(((p.z - 0.028) / 0.03).clamp(0.0, 1.0));
        let band = 1.0 - smooth(((up - 0.66).abs() / 0.5).clamp(0.0, 1.0));
        let forehead = smooth(((up - 1.25) / 0.3).clamp(0.0, 1.0)) * 0.26;
        let chin = smooth(((0.1 - up) / 0.5).clamp(0.0, 1.0)) * 0.10;
        let side = 1.0 - smooth(((aside - 0.66) / 0.3).clamp(0.0, 1.0));
        if self.on_lips(p) || self.on_lids(p) {
            return 0.0;
        }
        front * side * band.max(forehead).max(chin)
    }

    /// Returns the likelihood of an age spot: highest on temples, forehead and the sides of the
    /// cheeks.
    fn age_spots(&self, p: DVec3) -> f64 {
        let height = self.sellion.y - self.stomion.y;
        let up = (p.y - self.stomion.y) / height;
        let aside = p.x.abs() / self.lobe.x.max(0.03);
        let high = smooth(((up - 0.2) / 0.5).clamp(0.0, 1.0));
        let before = smooth(((p.z + 0.01) / 0.03).clamp(0.0, 1.0));
        if self.on_lips(p) || self.on_lids(p) {
            return 0.0;
        }
        before * high * (0.3 + 0.7 * smooth(((aside - 0.35) / 0.4).clamp(0.0, 1.0)))
    }

    /// Returns the likelihood of a mole: on the face and the sides of the neck.
    fn moles(&self, p: DVec3) -> f64 {
        let before = smooth(((p.z + 0.01) / 0.03).clamp(0.0, 1.0));
        let is_none = self.on_lips(p) || self.on_lids(p) || p.y > self.sellion.y + 0.06;
        if is_none { 0.0 } else { 0.6 * before }
    }

    /// Returns the density of stubble.
    fn stubble(&self, p: DVec3) -> f64 {
        let x = p.x.abs();
        let aside = x / self.lobe.x.max(0.03);
        let height = self.sellion.y - self.stomion.y;
        let lip = self.stomion.y + 0.30 * height;
        let corner = self.stomion.y - 0.02 * height;
        // Under the nose, down to the mouth's corner, up the cheek to the ear.
        let edge = if aside < 0.26 {
            lip
        } else if aside < 0.46 {
            lip + (corner - lip) * (aside - 0.26) / 0.20
        } else {
            corner + (self.lobe.y + 0.012 - corner) * ((aside - 0.46) / 0.50).min(1.0)
        };
        let below = smooth(((edge - p.y) / 0.008).clamp(0.0, 1.0));
        let neck = smooth(((p.y - self.gnathion.y + 0.026) / 0.02).clamp(0.0, 1.0));
        let before = smooth(((p.z - 0.002) / 0.012).clamp(0.0, 1.0));
        if self.on_lips(p) {
            0.0
        } else {
            below * neck * before
        }
    }

    /// Returns true if a point is near the eyes, whose lids have few marks.
    fn on_lids(&self, p: DVec3) -> bool {
        let (x, y) = (p.x.abs() / self.lobe.x.max(0.03), p.y - self.sellion.y);
        let (x, y) = ((x - 0.44) / 0.27, (y + 0.006) / 0.014);
        x * x + y * y < 1.0
    }

    pub(super) fn on_lips(&self, p: DVec3) -> bool {
        let off = p - self.stomion;
        let (x, y) = (off.x / 0.029, off.y / 0.0095);
        x * x + y * y < 1.0 && off.z > -0.03
    }
}

impl Reshaper {
    /// Returns the speckles of a kind on a figure produced by this reshaper, in random order: any
    /// first part of them is a fair sample of all. Each seed has its own positions.
    #[must_use]
    pub fn speckles(&self, figure: &Figure, kind: SpeckleKind, seed: u64) -> Vec<Speckle> {
        let Some(skin) = figure.meshes.get(self.head) else {
            return Vec::new();
        };
        let Some(places) = FacePoints::from_skin(&skin.positions, self.origin) else {
            return Vec::new();
        };
        // By area on the figure as it was: on every face the same spots.
        let own = &self.figure.meshes[self.head].positions;
        let mut total = 0.0;
        let sums: Vec<f64> = self
            .triangles
            .iter()
            .map(|t| {
                let [a, b, c] = t.map(|v| wide(own[v as usize]));
                total += (b - a).cross(c - a).length();
                total
            })
            .collect();
        (0..kind.tried())
            .filter_map(|i| {
                let dice = |k: u64| noise::unit(kind.stream(seed), k, i);
                let corners = *self
                    .triangles
                    .get(sums.partition_point(|s| *s < dice(0) * total))?;
                let (mut u, mut v) = (dice(1), dice(2));
                if u + v > 1.0 {
                    (u, v) = (1.0 - u, 1.0 - v);
                }
                let shares = [1.0 - u - v, u, v];
                let p: DVec3 = (0..3)
                    .map(|k| (wide(skin.positions[corners[k] as usize]) - self.origin) * shares[k])
                    .sum();
                let share = match kind {
                    SpeckleKind::Freckles => places.freckles(p),
                    SpeckleKind::Stubble => places.stubble(p),
                    SpeckleKind::AgeSpots => places.age_spots(p),
                    SpeckleKind::Moles => places.moles(p),
                };
                if dice(3) >= share {
                    return None;
                }
                let chart = self.chart(figure, &SurfacePoint { corners, shares })?;
                Some(Speckle {
                    chart,
                    strength: 0.3 + 0.7 * dice(4),
                })
            })
            .collect()
    }
}
