//! Guide chains of swinging hair: hanging hair follows the head like pendulums.
//!
//! A chain runs down the middle of the hair of its sector. A card that hangs between two chains
//! follows both; near its root it stays with the scalp.

use raconteur_base::{DVec3, ops};

use super::card::Card;
use super::comb::step;
use super::line::angles;
use super::style::{Comb, Length, Style};
use crate::part::JointRef;
use crate::springs::HairChain;
use raconteur_body::skeleton::{Bone, Drive};

/// Azimuths of the chains of hanging hair, degrees from the front to the left, round the back.
const AROUND_DEG: [f64; 15] = [
    62.0, 79.0, 96.0, 113.0, 130.0, 147.0, 163.0, 180.0, 197.0, 213.0, 230.0, 247.0, 264.0, 281.0,
    298.0,
];
/// Angular spread of guide hairs, degrees; the next constant is in metres.
const SECTOR_DEG: f64 = 9.0;
const SLICE_M: f64 = 0.012;
/// Height at which hanging hair leaves the head, and the length of a link, metres.
const TOP_M: f64 = -0.005;
const LINK_M: f64 = 0.045;
/// Azimuths of the chains of a fringe, degrees.
const FRINGE_DEG: [f64; 3] = [-28.0, 0.0, 28.0];
/// Hair combed forward that is longer than this is a fringe, metres.
const FRINGE_M: f64 = 0.02;
/// Distance from its root within which hair is fixed to the scalp, metres.
const ROOTED_M: f64 = 0.035;
/// Links of a tail.
const TAIL_LINKS: usize = 4;
/// Sum of weights of rows that a guide needs.
const MIN_WEIGHT_SUM: f64 = 0.5;

/// Layout of the joint chains of a style.
enum Kind {
    /// Round the head, by height.
    Hanging { top: f64, pitch: f64 },
    /// Chain over the forehead, from root to tip.
    Fringe,
    /// One chain, for tied hair.
    Tail,
    /// No chains.
    Still,
}

/// Guide chains of swinging hair on one head, frame of the hair. Hanging cards follow the chains
/// next to them.
pub(super) struct Chains {
    kind: Kind,
    pub(super) guides: Vec<HairChain>,
}

impl Chains {
    pub(super) fn new(style: &Style, cards: &[Card]) -> Self {
        match (style.length, style.comb) {
            (Length::Hem { .. }, _) => Self::hanging(cards),
            (_, Comb::Tied(_)) if cards.iter().any(|c| c.is_free) => Self::tail(cards),
            (_, Comb::Whorl) => Self::fringe(cards),
            (Length::Short { top, .. }, Comb::Combed { top: way, .. })
                if way.z > 0.3 && top > FRINGE_M =>
            {
                Self::fringe(cards)
            }
            _ => Self {
                kind: Kind::Still,
                guides: Vec::new(),
            },
        }
    }

    fn hanging(cards: &[Card]) -> Self {
        let rows: Vec<DVec3> = cards
            .iter()
            .flat_map(|c| c.rows.iter().map(super::card::Row::middle))
            .collect();
        let low = rows.iter().map(|p| p.y).fold(TOP_M, f64::min);
        let links = ((TOP_M - low) / LINK_M).round().max(1.0);
        let pitch = (TOP_M - low) / links;
        let guides = AROUND_DEG.iter().map(|&azimuth| {
            let points = (0..=links as usize).map_while(|k| {
                let y = TOP_M - pitch * k as f64;
                mean(rows.iter().map(|p| {
                    let off = turned_deg(*p, azimuth) / SECTOR_DEG;
                    let high = (p.y - y) / SLICE_M;
                    (*p, ops::exp(-0.5 * (off * off + high * high)))
                }))
            });
            HairChain {
                points: points.collect(),
                stiffness: 0.9,
                gravity: 0.18,
                drag: 0.4,
            }
        });
        Self {
            kind: Kind::Hanging { top: TOP_M, pitch },
            guides: guides.collect(),
        }
    }

    fn fringe(cards: &[Card]) -> Self {
        let end = |azimuth: f64, at: &dyn Fn(&Card) -> Option<DVec3>| {
            mean(cards.iter().filter(|c| in_fringe(c)).filter_map(|c| {
                let off = turned_deg(c.rows.first()?.middle(), azimuth) / SECTOR_DEG;
                Some((at(c)?, ops::exp(-0.5 * off * off)))
            }))
        };
        let guides = FRINGE_DEG.iter().filter_map(|&azimuth| {
            let root = end(azimuth, &|c| Some(c.rows.first()?.middle()))?;
            let tip = end(azimuth, &|c| Some(c.rows.last()?.middle()))?;
            Some(HairChain {
                points: vec![root, tip],
                stiffness: 0.5,
                gravity: 0.05,
                drag: 0.5,
            })
        });
        let guides: Vec<HairChain> = guides.collect();
        if guides.len() < FRINGE_DEG.len() {
            return Self {
                kind: Kind::Still,
                guides: Vec::new(),
            };
        }
        Self {
            kind: Kind::Fringe,
            guides,
        }
    }

    fn tail(cards: &[Card]) -> Self {
        let rows: Vec<DVec3> = cards
            .iter()
            .filter(|c| c.is_free)
            .flat_map(|c| c.rows.iter().map(super::card::Row::middle))
            .collect();
        let (low, high) = rows
            .iter()
            .map(|p| p.y)
            .fold((f64::MAX, f64::MIN), |(a, b), y| (a.min(y), b.max(y)));
        let top = high - SLICE_M;
        let points = (0..=TAIL_LINKS).filter_map(|k| {
            let y = top + (low - top) * k as f64 / TAIL_LINKS as f64;
            mean(rows.iter().map(|p| {
                let off = (p.y - y) / SLICE_M;
                (*p, ops::exp(-0.5 * off * off))
            }))
        });
        Self {
            kind: Kind::Tail,
            guides: vec![HairChain {
                points: points.collect(),
                stiffness: 0.2,
                gravity: 0.2,
                drag: 0.35,
            }],
        }
    }

    /// Returns the joint weights of a row of a card at `arc` metres from the root.
    pub(super) fn joints(&self, card: &Card, row: usize, arc: f64) -> Vec<(JointRef, f64)> {
        let at = card.rows[row].middle();
        let mut out = scalp(at);
        let loose = match &self.kind {
            Kind::Still => Vec::new(),
            Kind::Hanging { top, pitch } => {
                let free = step(0.0, ROOTED_M, arc);
                self.around(at, (top - at.y) / pitch, free)
            }
            Kind::Tail if card.is_free => self.links(0, self.down(at), 1.0),
            Kind::Fringe if in_fringe(card) => {
                let share = step(0.1, 1.0, card.rows[row].v);
                let root = card.rows[0].middle();
                let place = (turned_deg(root, FRINGE_DEG[0]) / (FRINGE_DEG[1] - FRINGE_DEG[0]))
                    .clamp(0.0, 1.999);
                let (i, f) = (place as usize, place.fract());
                let mut out = self.links(i, 0.5, share * (1.0 - f));
                out.extend(self.links(i + 1, 0.5, share * f));
                out
            }
            Kind::Tail | Kind::Fringe => Vec::new(),
        };
        let taken: f64 = loose.iter().map(|l| l.1).sum();
        for joint in &mut out {
            joint.1 *= 1.0 - taken;
        }
        out.extend(loose);
        out
    }

    /// Returns the weights of the two chains next to a position, `down` links from their roots.
    fn around(&self, at: DVec3, down: f64, share: f64) -> Vec<(JointRef, f64)> {
        let azimuth = angles(at).0.rem_euclid(360.0);
        let after = AROUND_DEG.partition_point(|a| *a < azimuth);
        let last = AROUND_DEG.len() - 1;
        let (first, f) = if after == 0 {
            (0, 0.0)
        } else if after > last {
            (last, 0.0)
        } else {
            let (a, b) = (AROUND_DEG[after - 1], AROUND_DEG[after]);
            (after - 1, (azimuth - a) / (b - a))
        };
        let mut out = self.links(first, down, share * (1.0 - f));
        if f > 0.0 {
            out.extend(self.links(first + 1, down, share * f));
        }
        out
    }

    /// Returns the number of links down the tail at a position.
    fn down(&self, at: DVec3) -> f64 {
        let points = &self.guides[0].points;
        let place = |(k, pair): (usize, &[DVec3])| {
            let along = pair[1] - pair[0];
            let t = (at - pair[0]).dot(along) / along.length_squared().max(1e-12);
            let held = t.clamp(0.0, 1.0);
            (at.distance((pair[0]).lerp(pair[1], held)), k as f64 + held)
        };
        let nearest = points.windows(2).enumerate().map(place);
        nearest
            .min_by(|a, b| a.0.total_cmp(&b.0))
            .map_or(0.0, |n| n.1)
    }

    /// Returns the weights of two links of a chain for a position `down` links from its root: half
    /// of each at the joint between them. Everything above the first belongs to the scalp.
    fn links(&self, chain: usize, down: f64, share: f64) -> Vec<(JointRef, f64)> {
        let last = self.guides[chain].points.len().saturating_sub(2);
        let place = (down - 0.5).max(-1.0);
        let (low, f) = (place.floor(), place - place.floor());
        [(low, 1.0 - f), (low + 1.0, f)]
            .into_iter()
            .filter(|(k, w)| *k >= 0.0 && *w > 0.0)
            .map(|(k, w)| {
                let drive = Drive::Spring(chain as u8, (k as usize).min(last) as u8);
                (JointRef(drive), w * share)
            })
            .collect()
    }
}

/// Returns true if a card is rooted over the forehead.
fn in_fringe(card: &Card) -> bool {
    let root = card.rows[0].middle();
    angles(root).0.abs() < 55.0 && root.z > 0.035
}

/// Returns the angle between a position and an azimuth, degrees within a half turn.
fn turned_deg(p: DVec3, azimuth: f64) -> f64 {
    (angles(p).0 - azimuth + 180.0).rem_euclid(360.0) - 180.0
}

fn mean(of: impl Iterator<Item = (DVec3, f64)>) -> Option<DVec3> {
    let (sum, weight) = of.fold((DVec3::ZERO, 0.0), |(s, w), (p, own)| {
        (s + p * own, w + own)
    });
    (weight > MIN_WEIGHT_SUM).then(|| sum / weight)
}

/// Returns the joint weights of the scalp at a position: the nape follows the neck slightly.
fn scalp(at: DVec3) -> Vec<(JointRef, f64)> {
    let bone = |b| JointRef(Drive::Bone(b));
    let neck = 0.3 * step(-0.04, -0.12, at.y);
    vec![
        (bone(Bone::Skull), 1.0 - neck),
        (bone(Bone::Cervical), neck),
    ]
}
