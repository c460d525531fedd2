//! The tiles of each part of the sheet.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use raconteur_player::base::{DQuat, DVec3, Side, ops};
use raconteur_player::body::{Bone, Figure, HandShape};
use raconteur_player::stage::{Camera, Lighting};

use super::posture::{Posed, Posture};
use super::view::{Places, before};
use super::{Part, light};

/// One view.
pub(crate) struct Tile {
    /// What it shows.
    pub(crate) caption: String,
    /// Width over height.
    pub(crate) aspect: f64,
    /// How the figure stands.
    pub(crate) posed: Posed,
    /// Where it is seen from.
    pub(crate) camera: Camera,
    /// What lights it.
    pub(crate) lighting: Lighting,
}

/// Makes tiles of one figure in one light.
struct Maker<'a> {
    figure: &'a Figure,
    lighting: Lighting,
}

/// The tiles of a part.
pub(super) fn of(figure: &Figure, part: Part, lighting: Lighting) -> Vec<Tile> {
    let maker = Maker { figure, lighting };
    match part {
        Part::All => Vec::new(),
        Part::Face => maker.face(),
        Part::Eyes => maker.eyes(),
        Part::Body => maker.body(),
        Part::Hands => maker.hands(),
        Part::Poses => maker.poses(),
        Part::Mouth => maker.mouth(),
        Part::Lights => maker.lights(),
    }
}

impl<'a> Maker<'a> {
    fn standing(&self) -> Posture<'a> {
        Posture::standing(self.figure)
    }

    fn tile(
        &self,
        caption: &str,
        aspect: f64,
        posture: Posture<'_>,
        camera: impl Fn(&Places<'_>) -> Camera,
    ) -> Tile {
        let posed = posture.posed();
        let camera = camera(&Places::new(self.figure, &posed.world_from_joint));
        Tile {
            caption: caption.to_owned(),
            aspect,
            posed,
            camera,
            lighting: self.lighting,
        }
    }

    /// A head and its neck, in any posture.
    fn head(&self, caption: &str, posture: Posture<'_>) -> Tile {
        self.tile(caption, 1.0, posture, |at| {
            let d = at.pupils_m();
            before(middle_of_head(at), 2.6 * d, 0.0, 0.0)
        })
    }

    fn face(&self) -> Vec<Tile> {
        [
            ("face front", 0.0),
            ("three-quarter", FRAC_PI_4),
            ("profile", FRAC_PI_2),
        ]
        .map(|(caption, yaw)| {
            let mut posture = self.standing();
            posture.facing(yaw);
            self.head(caption, posture)
        })
        .into()
    }

    fn eyes(&self) -> Vec<Tile> {
        let near = |caption, yaw: f64, lids, side: Option<Side>| {
            let mut posture = self.standing();
            posture.facing(yaw);
            posture.lids(lids);
            let aspect = if side.is_some() { 1.0 } else { 2.0 };
            self.tile(caption, aspect, posture, move |at| {
                let d = at.pupils_m();
                let target = side.map_or_else(|| at.between_eyes(), |s| at.eyes()[s.index()]);
                before(
                    target,
                    if side.is_some() { 0.42 } else { 0.62 } * d,
                    0.0,
                    0.0,
                )
            })
        };
        vec![
            near("eyes", 0.0, 0.0, None),
            near("left eye", -0.35, 0.0, Some(Side::Left)),
            near("lids half closed", 0.0, 0.5, None),
            near("lids closed", 0.0, 1.0, None),
        ]
    }

    fn whole(&self, caption: &str, aspect: f64, posture: Posture<'_>, top: f64) -> Tile {
        self.tile(caption, aspect, posture, |at| {
            let half = 0.5 * top * at.stature_m();
            before(DVec3::Y * (half - 0.02), 1.06 * half, 0.0, 0.03)
        })
    }

    fn body(&self) -> Vec<Tile> {
        [
            ("front", 0.0),
            ("three-quarter", FRAC_PI_4),
            ("side", FRAC_PI_2),
            ("back", PI),
        ]
        .map(|(caption, yaw)| {
            let mut posture = self.standing();
            posture.facing(yaw);
            self.whole(caption, 0.5, posture, 1.02)
        })
        .into()
    }

    /// A raised hand before the studio's wall.
    fn raised(&self, caption: &str, side: Side, shape: u8, palm: [f64; 3], yaw: f64) -> Tile {
        let mut posture = self.standing();
        posture.arm(side, [0.75, -0.60, 0.15], [0.42, 0.90, 0.15]);
        posture.hand(side, [0.10, 0.99, 0.06], palm);
        if let Some(shape) = HandShape::get(shape) {
            posture.shape(side, shape);
        }
        self.tile(caption, 1.0, posture, |at| {
            before(at.hand(side), 1.45 * at.palm_m(side), yaw, 0.0)
        })
    }

    fn hands(&self) -> Vec<Tile> {
        const OPEN: u8 = 4;
        const RELAXED: u8 = 0;
        const FIST: u8 = 14;
        const POINT: u8 = 19;
        const PINCH: u8 = 27;
        let (to_us, away, inwards) = ([0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [-1.0, 0.0, 0.15]);
        let (l, r) = (Side::Left, Side::Right);
        vec![
            self.raised("left palm", l, OPEN, to_us, 0.0),
            self.raised("left back", l, OPEN, away, 0.0),
            self.raised("right palm", r, RELAXED, to_us, 0.0),
            self.raised("right back", r, RELAXED, away, 0.0),
            self.raised("fist", l, FIST, to_us, 0.0),
            self.raised("fist, back", l, FIST, away, 0.3),
            self.raised("fist, thumb side", l, FIST, inwards, 0.2),
            self.raised("point", l, POINT, to_us, -0.3),
            self.raised("pinch", l, PINCH, to_us, -0.3),
            self.raised("pinch, thumb side", l, PINCH, inwards, -0.2),
        ]
    }

    fn poses(&self) -> Vec<Tile> {
        let mut turned = self.standing();
        let yaw = DQuat::from_rotation_y;
        turned.turn(Bone::Cervical, yaw(25_f64.to_radians()));
        turned.turn(Bone::Skull, yaw(35_f64.to_radians()));

        let mut bent = self.standing();
        let fold = 40_f64.to_radians();
        // The upper arm hangs a little forward; the forearm comes up to 140° from it.
        bent.arm(
            Side::Left,
            [0.12, -0.97, 0.20],
            [0.06, ops::cos(fold), ops::sin(fold)],
        );
        bent.hand(Side::Left, [0.06, 0.80, 0.60], [-0.9, 0.3, -0.4]);

        let mut tiles = vec![
            self.tile("head turned 60°", 1.0, turned, |at| {
                before(
                    middle_of_head(at) - DVec3::Y * (0.9 * at.pupils_m()),
                    3.4 * at.pupils_m(),
                    0.0,
                    0.0,
                )
            }),
            self.tile("arm bent 140°", 1.0, bent, |at| {
                before(
                    at.elbow(Side::Left) + DVec3::Y * (0.06 * at.stature_m()),
                    0.17 * at.stature_m(),
                    FRAC_PI_4,
                    0.0,
                )
            }),
        ];
        for (caption, yaw) in [("arms raised", 0.0), ("arms raised, back", PI)] {
            let mut raised = self.standing();
            for side in Side::BOTH {
                // A third of the rise is the girdle's (Inman, Saunders & Abbott 1944).
                raised.turn(
                    Bone::on(side, "scapula"),
                    DQuat::from_rotation_z(side.sign() * 24_f64.to_radians()),
                );
                raised.arm(side, [0.36, 0.93, 0.05], [0.20, 0.97, 0.12]);
                raised.hand(side, [0.08, 0.99, 0.10], [-0.9, 0.0, 0.45]);
            }
            raised.facing(yaw);
            tiles.push(self.tile(caption, 1.0, raised, |at| {
                before(
                    DVec3::Y * (0.93 * at.stature_m()),
                    0.36 * at.stature_m(),
                    0.0,
                    0.0,
                )
            }));
        }
        let mut out = self.standing();
        for side in Side::BOTH {
            out.arm(side, [1.0, 0.0, 0.05], [1.0, 0.02, 0.12]);
            out.hand(side, [1.0, 0.0, 0.1], [0.0, -1.0, 0.1]);
        }
        tiles.push(self.tile("arms out", 1.0, out, |at| {
            before(
                DVec3::Y * (0.78 * at.stature_m()),
                0.54 * at.stature_m(),
                0.0,
                0.0,
            )
        }));
        tiles
    }

    fn mouth(&self) -> Vec<Tile> {
        let near = |caption, jaw_deg: f64, morphs: &[(&str, f32)]| {
            let mut posture = self.standing();
            posture.jaw(jaw_deg.to_radians());
            for &(name, weight) in morphs {
                posture.morph(name, weight);
            }
            self.tile(caption, 1.0, posture, |at| {
                let d = at.pupils_m();
                before(at.between_eyes() - DVec3::Y * (1.2 * d), 0.72 * d, 0.0, 0.0)
            })
        };
        let retracted = [
            ("mouthUpperUp", 1.0),
            ("mouthLowerDown", 1.0),
            ("mouthStretch", 0.6),
        ];
        vec![
            near("lips at rest", 0.0, &[]),
            near("teeth, lips retracted", 8.0, &retracted),
            near("jaw open", 24.0, &[]),
            near("smile", 0.0, &[("mouthSmile", 0.8)]),
            near("pucker", 3.0, &[("mouthPucker", 0.9)]),
        ]
    }

    fn lights(&self) -> Vec<Tile> {
        light::compared()
            .into_iter()
            .map(|light| {
                let mut posture = self.standing();
                posture.facing(0.35);
                let mut tile = self.head(&format!("light {}", light.name), posture);
                tile.lighting = light.lighting;
                tile
            })
            .collect()
    }
}

fn middle_of_head(at: &Places<'_>) -> DVec3 {
    let eyes = at.between_eyes();
    // Turned heads keep their ears in the picture: half way back to the neck.
    DVec3::new(0.5 * eyes.x, eyes.y - 0.45 * at.pupils_m(), 0.5 * eyes.z)
}
