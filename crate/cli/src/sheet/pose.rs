//! Named poses for sheets and exports.

use core::f64::consts::PI;

use clap::ValueEnum;
use raconteur_base::{DQuat, Side, ops};
use raconteur_body::{Bone, Figure, HandShape};

use super::posture::{PosedFigure, Posture};

/// Named pose of a figure for contact sheets and exports.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(crate) enum PoseName {
    /// Bind pose, in which the figure was made.
    Bind,
    /// Standing, arms hanging.
    Standing,
    /// Both arms stretched out sideways, palms down.
    ArmsOut,
    /// Both arms raised by 160°.
    ArmsRaised,
    /// The left arm bent by 140°.
    ArmBent,
    /// The head turned by 60° to its left.
    HeadTurned,
    /// Standing with both hands closed.
    Fists,
}

/// Number of the fist among the hand shapes.
pub(super) const FIST: u8 = 14;

impl PoseName {
    /// Returns the pose as a modifiable posture; the bind pose stands.
    pub(super) fn posture(self, figure: &Figure) -> Posture<'_> {
        let mut posture = Posture::standing(figure);
        match self {
            Self::Bind | Self::Standing => {}
            Self::ArmsOut => {
                for side in Side::BOTH {
                    posture.arm(side, [1.0, 0.0, 0.05], [1.0, 0.02, 0.12]);
                    posture.hand(side, [1.0, 0.0, 0.1], [0.0, -1.0, 0.1]);
                }
            }
            Self::ArmsRaised => {
                for side in Side::BOTH {
                    // The girdle takes its share of the rise; 24° is designed, by eye.
                    let rise = DQuat::from_rotation_z(side.sign() * PI * 24.0 / 180.0);
                    posture.turn(Bone::on(side, "scapula"), rise);
                    posture.arm(side, [0.36, 0.93, 0.05], [0.20, 0.97, 0.12]);
                    posture.hand(side, [0.08, 0.99, 0.10], [-0.9, 0.0, 0.45]);
                }
            }
            Self::ArmBent => {
                let fold = 40_f64.to_radians();
                // The upper arm hangs a little forward; 140° of bend leave 40° between.
                posture.arm(
                    Side::Left,
                    [0.12, -0.97, 0.20],
                    [0.06, ops::cos(fold), ops::sin(fold)],
                );
                posture.hand(Side::Left, [0.06, 0.80, 0.60], [-0.9, 0.3, -0.4]);
            }
            Self::HeadTurned => {
                for (bone, degrees) in [(Bone::Cervical, 25.0_f64), (Bone::Skull, 35.0)] {
                    posture.turn(bone, DQuat::from_rotation_y(degrees.to_radians()));
                }
            }
            Self::Fists => {
                if let Some(fist) = HandShape::get(FIST) {
                    for side in Side::BOTH {
                        posture.shape(side, fist);
                    }
                }
            }
        }
        posture
    }

    /// Returns a figure in this pose, ready for rendering.
    pub(crate) fn posed(self, figure: &Figure) -> PosedFigure {
        if self == Self::Bind {
            return PosedFigure {
                world_from_joint: figure.inverse_bind.iter().map(|m| m.inverse()).collect(),
                morph_weights: vec![0.0; figure.morph_names.len()],
                tissue: Vec::new(),
            };
        }
        self.posture(figure).posed()
    }
}
