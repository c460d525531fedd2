//! Tissue of a face as lines over the body: springs of the skin, fibres of the muscles, and the
//! underlying bone.

use raconteur_base::{DAffine3, DVec3, NodeState};
use raconteur_body::face::{Network, Tissue};
use raconteur_stage::{Line, Visibility};

/// Colour of the springs: cool and faint, so muscles stand out against them.
const SPRING: [u8; 4] = [20, 90, 130, 150];
const SPRING_PX: f32 = 1.0;
/// Colour of the bone, RGBA.
const BONE: [u8; 4] = [232, 222, 196, 230];
/// Skin that is longer between two nodes spans a hole, as between the jaws, metres.
const HOLE_M: f32 = 0.0095;
/// Colours of a muscle at rest and in full contraction, RGBA.
const SLACK: [u8; 4] = [110, 14, 10, 210];
const TENSE: [u8; 4] = [255, 70, 20, 255];
const MUSCLE_PX: f32 = 2.0;

/// Fills `lines` with the visible parts of a tissue; empty if there are none. Of the springs only
/// the edges of the skin are drawn, each once or, at a border, not at all: diagonals and the ties
/// of the skin to deeper layers would hide them.
pub(crate) fn draw(
    shown: Visibility,
    (tissue, network): (&Tissue, &Network),
    nodes: &[NodeState],
    world_from_bind: DAffine3,
    lines: &mut Vec<Line>,
) {
    let place = |p: [f32; 3]| {
        let p = DVec3::from_array(p.map(f64::from));
        world_from_bind.transform_point3(p).as_vec3().to_array()
    };
    if shown.skull {
        for quad in &tissue.quads {
            let under = |k: usize| network.bone_under(tissue, usize::from(quad[k]));
            for k in 0..2 {
                let ends = [k, k + 1].map(|k| tissue.rest[usize::from(quad[k])]);
                let long = (0..3)
                    .map(|i| (ends[1][i] - ends[0][i]).powi(2))
                    .sum::<f32>();
                if let (Some(from), Some(to), true) =
                    (under(k), under(k + 1), long < HOLE_M * HOLE_M)
                {
                    lines.push(Line {
                        from_in_world: place(from),
                        to_in_world: place(to),
                        color: BONE,
                        width_px: SPRING_PX,
                    });
                }
            }
        }
    }
    if shown.springs {
        let node = |i: u16| {
            let i = usize::from(i);
            let off = nodes.get(i).map_or([0.0; 3], |n| n.displacement);
            let rest = tissue.rest[i];
            place([0, 1, 2].map(|k| rest[k] + off[k]))
        };
        for quad in &tissue.quads {
            for k in 0..2 {
                lines.push(Line {
                    from_in_world: node(quad[k]),
                    to_in_world: node(quad[k + 1]),
                    color: SPRING,
                    width_px: SPRING_PX,
                });
            }
        }
    }
    if shown.muscles {
        for fibre in &tissue.fibres {
            let tension = network.contraction(fibre.muscle) as f32;
            let mix = |k: usize| {
                let (from, to) = (f32::from(SLACK[k]), f32::from(TENSE[k]));
                (from + (to - from) * tension) as u8
            };
            let color = [mix(0), mix(1), mix(2), mix(3)];
            let first = usize::from(fibre.first);
            let mut from = place(network.fibre_place(tissue, first));
            for point in first + 1..first + usize::from(fibre.count) {
                let to = place(network.fibre_place(tissue, point));
                lines.push(Line {
                    from_in_world: from,
                    to_in_world: to,
                    color,
                    width_px: MUSCLE_PX + tension,
                });
                from = to;
            }
        }
    }
}
