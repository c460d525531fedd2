//! Tiles of each part of the sheet.

use core::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};

use raconteur_actor::articulation::{ORDINARY_LOUDNESS, articulate, hold_closures};
use raconteur_actor::lips::MouthTargets;
use raconteur_actor::parameters::VISEMES;
use raconteur_base::{DVec3, Side};
use raconteur_body::{Figure, HandShape};
use raconteur_speech::phones;
use raconteur_stage::{Camera, Lighting};
use raconteur_tissue::{FaceControls, Muscle};

use super::pose::{FIST, PoseName};
use super::posture::{PosedFigure, Posture};
use super::view::{FigurePoints, before};
use super::{FaceView, SheetPart, light};

/// Hand shapes by number.
const RELAXED: u8 = 0;
const OPEN: u8 = 4;
const POINT: u8 = 19;
const PINCH: u8 = 27;

/// Rendering style of a tile.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    /// Lit rendering by the renderer.
    Lit,
    /// Edges of triangles.
    Wire,
    /// White before black.
    Silhouette,
}

/// Tile of a contact sheet: posed figure, camera, light, style and caption.
pub(crate) struct Tile {
    /// Caption.
    pub(crate) caption: String,
    /// Width over height.
    pub(crate) aspect: f64,
    /// Pose of the figure.
    pub(crate) posed: PosedFigure,
    /// Camera.
    pub(crate) camera: Camera,
    /// Lighting.
    pub(crate) lighting: Lighting,
    /// Rendering style.
    pub(crate) style: Style,
}

/// Builder of contact sheet tiles of one figure in one light.
pub(super) struct Maker<'a> {
    figure: &'a Figure,
    lighting: Lighting,
}

/// Returns the tiles of one part of the sheet.
pub(super) fn tiles(figure: &Figure, part: SheetPart, lighting: Lighting) -> Vec<Tile> {
    let maker = Maker { figure, lighting };
    match part {
        SheetPart::All => Vec::new(),
        SheetPart::Face => maker.face(),
        SheetPart::Hair => maker.hair(),
        SheetPart::Eyes => maker.eyes(),
        SheetPart::Body => maker.body(),
        SheetPart::Hands => maker.hands(),
        SheetPart::Shapes => maker.shapes(),
        SheetPart::Poses => maker.poses(),
        SheetPart::Mouth => maker.mouth(),
        SheetPart::Muscles => maker.muscles(),
        SheetPart::Visemes => maker.visemes(),
        SheetPart::Emotions => maker.emotions(),
        SheetPart::Blink => maker.blink(),
        SheetPart::Portrait => vec![maker.portrait()],
        SheetPart::Lights => maker.lights(),
        SheetPart::Wireframe => maker.wireframe(),
        SheetPart::Silhouette => maker.silhouette(),
    }
}

/// Returns tiles of the face from the given views, in studio light.
pub(super) fn faces(figure: &Figure, views: &[FaceView], caption: &str) -> Vec<Tile> {
    let maker = Maker {
        figure,
        lighting: Lighting::default(),
    };
    let turns = views.iter().map(|view| match view {
        FaceView::Front => (caption, 0.0),
        FaceView::ThreeQuarter => (caption, FRAC_PI_4),
        FaceView::Profile => (caption, FRAC_PI_2),
    });
    maker.turned(&turns.collect::<Vec<_>>())
}

impl<'a> Maker<'a> {
    pub(super) fn standing(&self) -> Posture<'a> {
        Posture::standing(self.figure)
    }

    pub(super) fn tile(
        &self,
        caption: &str,
        aspect: f64,
        posture: Posture<'_>,
        camera: impl Fn(&FigurePoints<'_>) -> Camera,
    ) -> Tile {
        let posed = posture.posed();
        let camera = camera(&FigurePoints::new(self.figure, &posed.world_from_joint));
        Tile {
            caption: caption.to_owned(),
            aspect,
            posed,
            camera,
            lighting: self.lighting,
            style: Style::Lit,
        }
    }

    /// Returns a tile of head and neck in any pose.
    pub(super) fn head(&self, caption: &str, posture: Posture<'_>) -> Tile {
        self.tile(caption, 1.0, posture, |at| {
            let d = at.pupils_m();
            before(middle_of_head(at), 2.45 * d, 0.0, 0.0)
        })
    }

    fn face(&self) -> Vec<Tile> {
        self.turned(&[
            ("face front", 0.0),
            ("three-quarter", FRAC_PI_4),
            ("profile", FRAC_PI_2),
        ])
    }

    fn hair(&self) -> Vec<Tile> {
        self.turned(&[
            ("hair front", 0.0),
            ("hair three-quarter", FRAC_PI_4),
            ("hair profile", FRAC_PI_2),
            ("hair back", PI),
        ])
    }

    /// Returns tiles of the head from several sides; each view has a caption and a rotation of the
    /// body, radians.
    fn turned(&self, views: &[(&str, f64)]) -> Vec<Tile> {
        views
            .iter()
            .map(|(caption, yaw)| {
                let mut posture = self.standing();
                posture.facing(*yaw);
                self.head(caption, posture)
            })
            .collect()
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

    /// Returns a tile of a raised hand with a hand shape and palm orientation, in front of the
    /// studio's wall.
    fn raised(&self, caption: &str, side: Side, shape: u8, palm: [f64; 3], yaw: f64) -> Tile {
        let posture = self.raised_posture(side, shape, palm);
        self.tile(caption, 1.0, posture, |at| {
            before(at.hand(side), 1.3 * at.palm_m(side), yaw, 0.0)
        })
    }

    fn raised_posture(&self, side: Side, shape: u8, palm: [f64; 3]) -> Posture<'a> {
        let mut posture = self.standing();
        posture.arm(side, [0.75, -0.60, 0.15], [0.42, 0.90, 0.15]);
        posture.hand(side, [0.10, 0.99, 0.06], palm);
        if let Some(shape) = HandShape::get(shape) {
            posture.shape(side, shape);
        }
        posture
    }

    fn hands(&self) -> Vec<Tile> {
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

    /// Returns tiles of handshapes, slightly rotated so that a thumb in front of the palm is
    /// visible, with room for an extended one.
    fn shapes(&self) -> Vec<Tile> {
        let side = Side::Right;
        HandShape::ALL
            .iter()
            .map(|shape| {
                let caption = format!("{} {}", shape.id(), shape.name());
                let posture = self.raised_posture(side, shape.id(), [0.3, 0.0, 1.0]);
                self.tile(&caption, 1.0, posture, |at| {
                    let aside = DVec3::X * (0.13 * at.palm_m(side));
                    before(at.hand(side) + aside, 1.22 * at.palm_m(side), 0.0, 0.0)
                })
            })
            .collect()
    }

    fn poses(&self) -> Vec<Tile> {
        let pose = |name: PoseName| name.posture(self.figure);
        let mut tiles = vec![
            self.tile("head turned 60°", 1.0, pose(PoseName::HeadTurned), |at| {
                let d = at.pupils_m();
                before(middle_of_head(at) - DVec3::Y * (0.7 * d), 3.2 * d, 0.0, 0.0)
            }),
            self.tile("arm bent 140°", 1.0, pose(PoseName::ArmBent), |at| {
                let s = at.stature_m();
                let target = at.elbow(Side::Left) + DVec3::Y * (0.06 * s);
                before(target, 0.15 * s, FRAC_PI_4, 0.0)
            }),
        ];
        for (caption, yaw) in [("arms raised", 0.0), ("arms raised, back", PI)] {
            let mut raised = pose(PoseName::ArmsRaised);
            raised.facing(yaw);
            tiles.push(self.tile(caption, 1.0, raised, |at| {
                let s = at.stature_m();
                before(DVec3::Y * (0.93 * s), 0.36 * s, 0.0, 0.0)
            }));
        }
        tiles.push(self.tile("arms out", 1.0, pose(PoseName::ArmsOut), |at| {
            let s = at.stature_m();
            before(DVec3::Y * (0.78 * s), 0.54 * s, 0.0, 0.0)
        }));
        tiles
    }

    fn wireframe(&self) -> Vec<Tile> {
        let turned = |yaw| {
            let mut posture = self.standing();
            posture.facing(yaw);
            posture
        };
        let mut tiles = vec![
            self.head("wireframe", self.standing()),
            self.head("profile", turned(FRAC_PI_2)),
            self.raised("hand, back", Side::Left, OPEN, [0.0, 0.0, -1.0], 0.0),
            self.whole("body", 0.5, self.standing(), 1.02),
            self.whole("side", 0.5, turned(FRAC_PI_2), 1.02),
        ];
        for tile in &mut tiles {
            tile.style = Style::Wire;
        }
        tiles
    }

    fn silhouette(&self) -> Vec<Tile> {
        let posed = PoseName::Bind.posed(self.figure);
        let middle = 0.5 * self.figure.skeleton.stature_m();
        vec![Tile {
            caption: String::new(),
            aspect: 1.0,
            posed,
            // The same in every sheet, for comparison: level, at half stature, 8 % of room.
            camera: before(DVec3::Y * middle, 1.08 * middle, 0.0, 0.0),
            lighting: self.lighting,
            style: Style::Silhouette,
        }]
    }

    /// Returns a tile of the lower half of a face with given controls.
    fn lips(&self, caption: &str, controls: FaceControls) -> Tile {
        let mut posture = self.standing();
        posture.face(controls);
        self.tile(caption, 1.0, posture, |at| {
            let d = at.pupils_m();
            before(at.between_eyes() - DVec3::Y * (1.2 * d), 0.72 * d, 0.0, 0.0)
        })
    }

    fn mouth(&self) -> Vec<Tile> {
        let of = |jaw_deg: f64, protrusion: f64, muscles: &[(Muscle, f64)]| {
            let mut controls = contracted(muscles);
            controls.jaw.pitch_rad = jaw_deg.to_radians();
            controls.protrusion = [protrusion; 2];
            controls
        };
        let retracted = [
            (Muscle::LevatorLabiiLeft, 1.0),
            (Muscle::DepressorLabiiLeft, 1.0),
            (Muscle::RisoriusLeft, 0.6),
        ];
        let smile = [
            (Muscle::ZygomaticusMajorLeft, 0.8),
            (Muscle::OrbicularisOculiLeft, 0.4),
        ];
        let ring = [
            (Muscle::OrbicularisOrisUpper, 0.7),
            (Muscle::OrbicularisOrisLower, 0.7),
        ];
        vec![
            self.lips("lips at rest", of(0.0, 0.0, &[])),
            self.lips("teeth, lips retracted", of(8.0, 0.0, &retracted)),
            self.lips("jaw open", of(20.0, 0.0, &[])),
            self.lips("smile", of(0.0, 0.0, &smile)),
            self.lips("pucker", of(3.0, 0.9, &ring)),
        ]
    }

    /// Returns a tile for every muscle, contracted on both sides.
    fn muscles(&self) -> Vec<Tile> {
        Muscle::all()
            .filter(|m| m.side() != Some(Side::Right))
            .map(|muscle| {
                let mut posture = self.standing();
                posture.facing(0.3);
                posture.face(contracted(&[(muscle, 1.0)]));
                let name = muscle.name();
                self.head(name.strip_suffix("Left").unwrap_or(name), posture)
            })
            .collect()
    }

    fn visemes(&self) -> Vec<Tile> {
        VISEMES
            .iter()
            .map(|&(viseme, phone)| {
                let mut controls = FaceControls::default();
                if let Some(row) = phones::by_name(phone) {
                    articulate(
                        &MouthTargets::from_phone(row),
                        ORDINARY_LOUDNESS,
                        &mut controls,
                    );
                }
                hold_closures(&mut controls);
                self.lips(viseme, controls)
            })
            .collect()
    }

    fn lights(&self) -> Vec<Tile> {
        light::names()
            .into_iter()
            .filter_map(|name| Some((name, light::named(name)?)))
            .map(|(name, lighting)| {
                let mut posture = self.standing();
                posture.facing(0.35);
                let mut tile = self.head(&format!("light {name}"), posture);
                tile.lighting = lighting;
                tile
            })
            .collect()
    }
}

/// Returns face controls with the given muscles contracted on both sides.
fn contracted(muscles: &[(Muscle, f64)]) -> FaceControls {
    let mut controls = FaceControls::default();
    for (muscle, contraction) in muscles {
        controls.contraction[muscle.index()] = *contraction;
        controls.contraction[muscle.mirrored().index()] = *contraction;
    }
    controls
}

pub(super) fn middle_of_head(at: &FigurePoints<'_>) -> DVec3 {
    let eyes = at.between_eyes();
    // Halfway back to the neck, so that turned heads keep their ears in the frame.
    DVec3::new(0.5 * eyes.x, eyes.y - 0.45 * at.pupils_m(), 0.5 * eyes.z)
}
