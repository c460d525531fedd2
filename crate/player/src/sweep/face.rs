//! Visible faults of the face: lips that stay apart in a closure, lids that do not meet, skin in
//! skin, teeth or bone.

use std::ops::RangeInclusive;

use raconteur_body::Figure;
use raconteur_body::face::{FaceControls, Network, NodeState, Tissue};
use raconteur_speech::phones::Class;

use super::{Check, Folds, MAX_FOLD_DEPTH_MM, RATE_HZ, frames};
use crate::lower::cues::CueKind;
use crate::play::player::Player;

/// Factor of the additional test with faster speech.
const FAST: f64 = 1.5;
/// Share of a plosive with closed lips; its release follows.
const CLOSED: f64 = 0.75;
/// Time in which silence closes the mouth, and in which the mouth opens after it, seconds.
const SILENCE_CLOSES_SECS: f64 = 0.2;
const SILENCE_OPENS_SECS: f64 = 0.15;
/// Radius of the globe that lids slide over, millimetres.
const GLOBE_MM: f64 = 12.2;
/// Lid control from which the lids have to be closed: a blink at its apex.
const FULL: f64 = 0.999;
/// Contraction of any muscle from which the lips are not checked in silence: an expression.
const STILL: f64 = 0.35;

/// A time interval in which a condition must hold.
struct CheckedSpan {
    from_secs: f64,
    to_secs: f64,
    closure: Closure,
    phone: &'static str,
}

#[derive(Clone, Copy, PartialEq)]
enum Closure {
    Bilabial,
    Labiodental,
    Silence,
}

/// Returns the checked intervals of all speech, by time.
fn moments(player: &Player) -> Vec<CheckedSpan> {
    let mut all = Vec::new();
    for cue in player.cues() {
        let &CueKind::Phone { utterance, phone } = &cue.kind else {
            continue;
        };
        let timed = &player.utterances()[utterance].timed;
        let phone = &timed.utterance.phones[phone];
        let target = phone.row.targets();
        let (start, end) = (cue.time_secs, timed.story_secs(phone.end_secs));
        let (closure, from_secs, to_secs) = match target.class {
            Class::BilabialStop => (Closure::Bilabial, start, start + CLOSED * (end - start)),
            Class::BilabialNasal => (Closure::Bilabial, start, end),
            Class::Labiodental => (Closure::Labiodental, start, end),
            Class::Silence => (
                Closure::Silence,
                start + SILENCE_CLOSES_SECS,
                end - SILENCE_OPENS_SECS,
            ),
            _ => continue,
        };
        if to_secs > from_secs {
            all.push(CheckedSpan {
                from_secs,
                to_secs,
                closure,
                phone: target.name,
            });
        }
    }
    all
}

/// Checks of the face in one pass over a story: lip closures, lids, teeth, bone, skin stretch and
/// folds.
pub(super) struct FaceSweep {
    moments: Vec<CheckedSpan>,
    next: usize,
    bilabial: Check,
    labiodental: Check,
    silence: Check,
    lids: Check,
    lips: Check,
    teeth: Check,
    bone: Check,
    stretch: Check,
    folded: Check,
    folds: Option<Folds>,
}

impl FaceSweep {
    pub(super) fn new(player: &Player) -> Self {
        Self {
            moments: moments(player),
            next: 0,
            bilabial: Check::new("lips-apart", 0.5, "mm"),
            labiodental: Check::new("lip-from-teeth", 1.0, "mm"),
            silence: Check::new("mouth-open-in-silence", 1.0, "mm"),
            lids: Check::new("lids-apart", 0.5, "mm"),
            lips: Check::new("lip-in-lip", 1.0, "mm"),
            teeth: Check::new("lip-in-teeth", 1.0, "mm"),
            bone: Check::new("skin-in-bone", 1.0, "mm"),
            stretch: Check::new("skin-stretched", 2.5, ""),
            folded: Check::new("skin-folded", MAX_FOLD_DEPTH_MM, "mm"),
            folds: Folds::new(player.figure()),
        }
    }

    /// Measures a time; times ascend.
    pub(super) fn measure(
        &mut self,
        (tissue, network): (&Tissue, &Network),
        controls: &FaceControls,
        t: f64,
    ) {
        while self.moments.get(self.next).is_some_and(|m| m.to_secs < t) {
            self.next += 1;
        }
        let apart_mm = 1e3 * f64::from(network.lips_apart_m(tissue));
        for moment in &self.moments[self.next..] {
            if moment.from_secs > t {
                break;
            }
            if t > moment.to_secs {
                continue;
            }
            match moment.closure {
                Closure::Bilabial => self.bilabial.measure(apart_mm, moment.phone, t),
                Closure::Labiodental => {
                    let from_mm = 1e3 * f64::from(network.lip_to_teeth_m(tissue));
                    self.labiodental.measure(from_mm, moment.phone, t);
                }
                // An open mouth may be an expression.
                Closure::Silence if controls.contraction.iter().all(|c| *c < STILL) => {
                    self.silence.measure(apart_mm, moment.phone, t);
                }
                Closure::Silence => {}
            }
        }
        let depths = network.left(tissue);
        for (check, depth) in [
            (&mut self.lips, depths.lips_m),
            (&mut self.teeth, depths.teeth_m),
            (&mut self.bone, depths.bone_m),
        ] {
            check.measure(1e3 * f64::from(depth), "face", t);
        }
        self.stretch
            .measure(f64::from(network.most_stretched_edge()), "face", t);
    }

    /// Searches for dents in the skin of the figure that the sweep began with, as rendered.
    pub(super) fn look_for_folds(&mut self, figure: &Figure, nodes: &[NodeState], t: f64) {
        if let Some(folds) = &mut self.folds {
            let depth_mm = 1e3 * f64::from(folds.deepest(figure, nodes).depth_m);
            self.folded.measure(depth_mm, "face", t);
        }
    }

    /// Checks the lids that are controlled to close.
    pub(super) fn look_at_lids(
        &mut self,
        controls: &FaceControls,
        (are_rad, closed_rad): ([f64; 2], [f64; 2]),
        t: f64,
    ) {
        for i in 0..2 {
            if controls.upper_lid[i] > FULL {
                let apart = (closed_rad[i] - are_rad[i]).max(0.0);
                self.lids.measure(GLOBE_MM * apart, "lid", t);
            }
        }
    }

    pub(super) fn checks(self) -> Vec<Check> {
        vec![
            self.bilabial,
            self.labiodental,
            self.silence,
            self.lids,
            self.lips,
            self.teeth,
            self.bone,
            self.stretch,
            self.folded,
        ]
    }
}

/// Checks the same story with faster speech than its skin: closures must still close.
pub(super) fn fast(player: &Player, secs: &RangeInclusive<f64>) -> Vec<Check> {
    let Some((tissue, _)) = player.face() else {
        return Vec::new();
    };
    let mut sweep = FaceSweep::new(player);
    let mut network = Network::new(tissue);
    let rest = player.face_controls(*secs.start());
    network.reset(tissue, &rest, &rest);
    for i in frames(secs, RATE_HZ / FAST) {
        let t = i as f64 * FAST / RATE_HZ;
        let controls = player.face_controls(t);
        network.step(tissue, &controls);
        sweep.measure((tissue, &network), &controls, t);
    }
    let mut checks = sweep.checks();
    checks.retain(|c| !matches!(c.name, "lids-apart" | "skin-folded"));
    for check in &mut checks {
        check.name = match check.name {
            "lips-apart" => "lips-apart-fast",
            "lip-from-teeth" => "lip-from-teeth-fast",
            "mouth-open-in-silence" => "mouth-open-in-silence-fast",
            "lip-in-lip" => "lip-in-lip-fast",
            "lip-in-teeth" => "lip-in-teeth-fast",
            "skin-in-bone" => "skin-in-bone-fast",
            _ => "skin-stretched-fast",
        };
    }
    checks
}
