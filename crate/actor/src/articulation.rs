//! Conversion from mouth channels to muscles, jaw and tongue (F&H section 3.1.3).
//!
//! Speech moves few muscles: both halves of the orbicularis oris, which contract, protrude and
//! retract; mentalis, risorius and the depressor of the lower lip; here also, slightly, the
//! levators of the upper lip. Other expressions are added to these, and closures keep the share of
//! the sum that they need.

use raconteur_base::Side;
use raconteur_base::curve::lerp;
use raconteur_body::face::{APART, FaceControls, Muscle};
use raconteur_speech::phones::Channel;

use crate::lips::MouthTargets;

use Muscle as M;

/// Loudness of ordinary speech, of 0 (as quiet as can be) to 1 (shouted).
pub const ORDINARY_LOUDNESS: f64 = 0.5;
/// Pitch of the jaw at a channel value of 1, radians. Speech opens the mouth less than the full
/// range of F&H's jaw channel: the widest vowel turns the jaw by 9°, as when speaking to a room.
/// Designed.
pub const JAW_RAD: f64 = 0.245;
/// Lip aperture produced by a jaw channel of 1 alone, as a lip channel. Designed.
const LIPS_OF_JAW: f64 = 0.9;
/// Relative growth of vowel openings from ordinary speech to the loudest, and their reduction to
/// the quietest, as a share. Designed.
const LOUDER: f64 = 0.4;
/// Limit of the jaw and lip channels up to which consonants open the mouth, in the table of phones.
/// Loudness changes only the part beyond.
const CONSONANT_JAW: f64 = 0.18;
const CONSONANT_LIPS: f64 = 0.25;
/// Forward displacement of the jaw for a sibilant, metres. Designed: the teeth meet edge to edge.
const SIBILANT_M: f64 = 0.002;

/// Adds the speech articulation of the mouth to a face: contractions, jaw, tongue, and the strength
/// of lip closures. `loudness` is that of the voice, 0 to 1 with [`ORDINARY_LOUDNESS`] in the
/// middle; it scales vowel openings, never closures.
pub fn articulate(mouth: &MouthTargets, loudness: f64, controls: &mut FaceControls) {
    let value = |channel: Channel| mouth.channel(channel);
    let free = 1.0 - mouth.press.max(mouth.bite);
    let louder = if loudness.is_nan() {
        0.0
    } else {
        2.0 * LOUDER * (loudness.clamp(0.0, 1.0) - ORDINARY_LOUDNESS) * free
    };
    let voiced = |opening: f64, consonant: f64| opening + louder * (opening - consonant).max(0.0);
    let jaw = voiced(value(Channel::Jaw), CONSONANT_JAW);
    let open = voiced(value(Channel::LipOpen), CONSONANT_LIPS);
    controls.jaw.pitch_rad += JAW_RAD * jaw;
    // Of the sounds with the tip of the tongue raised, sibilants have the jaw nearly closed
    // and the lips open.
    let hiss = value(Channel::TongueTip)
        * (1.0 - value(Channel::Jaw) / 0.15).clamp(0.0, 1.0)
        * (open / 0.2).clamp(0.0, 1.0);
    controls.jaw.forward_m += SIBILANT_M * hiss * free;

    let round = value(Channel::Protrude);
    for (i, half) in [M::OrbicularisOrisUpper, M::OrbicularisOrisLower]
        .into_iter()
        .enumerate()
    {
        controls.contraction[half.index()] += value(Channel::OoContract);
        controls.protrusion[i] += round;
    }
    // The lips provide the opening that exceeds the jaw's; rounded lips hide the teeth.
    let own = (open - LIPS_OF_JAW * jaw).max(0.0);
    let bare = 1.0 - 0.6 * round.max(0.0);
    let raised = (0.55 * own + 0.11 * open) * bare;
    for (muscle, contraction) in [
        (
            M::DepressorLabiiLeft,
            (0.5 * own + 0.15 * value(Channel::DeprLabii)) * bare,
        ),
        (M::LevatorLabiiLeft, raised),
        (M::ZygomaticusMinorLeft, 0.5 * raised),
        (M::RisoriusLeft, 0.5 * value(Channel::Spread)),
        (
            M::MentalisLeft,
            0.5 * value(Channel::Mentalis) * (1.0 - mouth.bite),
        ),
    ] {
        for side in Side::BOTH {
            controls.contraction[muscle.index() + side.index()] += contraction;
        }
    }
    controls.seal += mouth.press;
    controls.bite += mouth.bite;
    controls.tongue_tip += value(Channel::TongueTip);
    controls.tongue_back += value(Channel::TongueBack);
    controls.tongue_out += value(Channel::TongueOut);
}

/// Pitch of the jaw beyond which lips do not stay sealed, nor the lower lip at the teeth,
/// radians. Designed: lips of a usual build reach each other over a third of a full opening.
const SEALED_RAD: f64 = 0.12;
const BITTEN_RAD: f64 = 0.03;

/// Enforces closures in a face driven by several sources: within a seal or a bite, it cancels
/// contractions that pull the lips apart and limits an open jaw. Call this last; it first limits
/// the face to its ranges ([`FaceControls::limit`]).
pub fn hold_closures(controls: &mut FaceControls) {
    controls.limit();
    let (seal, bite) = (controls.seal, controls.bite);
    for (muscle, by_seal, by_bite) in APART {
        let sealed = 1.0 - 0.01 * f64::from(by_seal) * seal;
        let bitten = 1.0 - 0.01 * f64::from(by_bite) * bite;
        controls.contraction[muscle.index()] *= sealed.min(bitten);
    }
    let pitch = &mut controls.jaw.pitch_rad;
    for (share, most) in [(seal, SEALED_RAD), (bite, BITTEN_RAD)] {
        *pitch = lerp(*pitch, pitch.min(most), share);
    }
    controls.jaw.down_m *= 1.0 - seal.max(bite);
}

#[cfg(test)]
mod tests {
    use super::*;
    use raconteur_base::noise;
    use raconteur_body::face::MUSCLES;
    use raconteur_speech::Phone;
    use raconteur_speech::phones;

    use crate::lips::LipTrack;

    /// Returns a phone's own targets on a face at rest.
    fn face(symbol: &str, loudness: f64) -> FaceControls {
        let mut mouth = MouthTargets {
            channels: phones::by_name(symbol).expect("a phone").channels,
            ..MouthTargets::default()
        };
        match symbol {
            "p" | "b" | "m" => mouth.press = 1.0,
            "f" | "v" => mouth.bite = 0.9,
            _ => {}
        }
        let mut controls = FaceControls::default();
        articulate(&mouth, loudness, &mut controls);
        controls
    }

    fn contraction_of(controls: &FaceControls, muscle: Muscle) -> f64 {
        controls.contraction[muscle.index()]
    }

    #[test]
    fn phones_move_what_makes_them() {
        let ordinary = |symbol: &str| face(symbol, ORDINARY_LOUDNESS);
        let [aa, iy, uw, s, sh, n, k, th, p, f] =
            ["aa", "iy", "uw", "s", "sh", "n", "k", "th", "p", "f"].map(ordinary);
        assert!(
            (aa.jaw.pitch_rad - 0.65 * JAW_RAD).abs() < 1e-12,
            "an open vowel lowers the jaw by its share"
        );
        assert!(
            contraction_of(&iy, M::RisoriusLeft) > 4.0 * contraction_of(&aa, M::RisoriusLeft),
            "iy spreads the lips more than aa"
        );
        assert!(
            uw.protrusion[0] > 0.7 && contraction_of(&uw, M::OrbicularisOrisLower) > 0.5,
            "uw protrudes and rounds the lips"
        );
        assert!(
            contraction_of(&iy, M::DepressorLabiiRight) > 0.1
                && contraction_of(&iy, M::LevatorLabiiRight) > 0.1,
            "iy contracts the lip depressor and levator"
        );
        assert!(s.jaw.forward_m > 5e-4 && sh.jaw.forward_m > 3e-4, "{s:?}");
        for other in [&aa, &iy, &uw, &n, &k, &p, &f] {
            assert!(other.jaw.forward_m < 1e-4, "{other:?}");
        }
        assert_eq!(
            (n.tongue_tip, k.tongue_back, th.tongue_out),
            (1.0, 1.0, 0.65)
        );
        assert!(
            p.seal == 1.0 && f.bite == 0.9 && p.bite == 0.0 && f.seal == 0.0,
            "bilabials seal and labiodentals bite"
        );
        assert!(
            contraction_of(&p, M::MentalisLeft) > contraction_of(&aa, M::MentalisLeft),
            "p contracts the mentalis more than aa"
        );
        assert_eq!(ordinary("pau"), FaceControls::default());
    }

    #[test]
    fn speech_is_the_same_on_both_sides() {
        for symbol in ["aa", "iy", "uw", "s", "p", "f", "m", "th"] {
            let controls = face(symbol, 0.8);
            for muscle in Muscle::all() {
                assert_eq!(
                    contraction_of(&controls, muscle),
                    contraction_of(&controls, muscle.mirrored())
                );
            }
            assert!(
                controls.jaw.yaw_rad == 0.0 && controls.protrusion[0] == controls.protrusion[1],
                "speech moves both sides equally"
            );
        }
    }

    #[test]
    fn a_loud_voice_opens_vowels_and_no_closure() {
        for symbol in ["aa", "ae", "ao", "eh"] {
            let [quiet, ordinary, loud] = [0.0, 0.5, 1.0].map(|l| face(symbol, l).jaw.pitch_rad);
            assert!(quiet < 0.9 * ordinary && loud > 1.1 * ordinary, "{symbol}");
        }
        for symbol in ["p", "b", "m", "f", "v", "t", "s", "pau"] {
            assert_eq!(face(symbol, 0.0), face(symbol, 1.0), "{symbol}");
        }
        // Nor one that a vowel's opening has not left yet.
        let mouth = MouthTargets {
            channels: phones::by_name("aa").expect("a phone").channels,
            press: 1.0,
            bite: 0.0,
        };
        let [quiet, loud] = [0.0, 1.0].map(|loudness| {
            let mut controls = FaceControls::default();
            articulate(&mouth, loudness, &mut controls);
            controls
        });
        assert_eq!(quiet, loud);
        assert_eq!(face("aa", f64::NAN), face("aa", ORDINARY_LOUDNESS));
        assert_eq!(face("aa", 7.0), face("aa", 1.0));
    }

    /// Creates a test utterance of random phones in which every third is `every`.
    fn utterance(every: &str, seed: u64) -> Vec<Phone> {
        let others = ["aa", "iy", "uw", "s", "ae", "l", "ow", "k", "sh"];
        (0..45)
            .map(|i| {
                let pick = (noise::unit(seed, 2, i) * others.len() as f64) as usize;
                let symbol = if i % 3 == 1 { every } else { others[pick] };
                Phone::new(symbol, 0.09 * i as f64, 0.09 * (i + 1) as f64, None)
            })
            .collect()
    }

    #[test]
    fn closures_have_their_way_in_any_context_with_any_expression() {
        for (seed, every) in ["p", "b", "m", "f", "v"]
            .into_iter()
            .cycle()
            .take(40)
            .enumerate()
        {
            let list = utterance(every, seed as u64);
            let track = LipTrack::new(&list);
            for (i, phone) in list.iter().enumerate().filter(|(_, p)| p.symbol == every) {
                let middle = 0.5 * (phone.start_secs + phone.end_secs);
                let mut controls = FaceControls::default();
                articulate(&track.sample(middle), 1.0, &mut controls);
                for k in 0..MUSCLES {
                    controls.contraction[k] += noise::unit(seed as u64, k as u64, i as i64);
                }
                controls.jaw.pitch_rad += 0.35;
                controls.jaw.down_m += 0.004;
                hold_closures(&mut controls);
                let most = 1.0 - controls.seal.max(controls.bite);
                assert!(
                    contraction_of(&controls, M::DepressorLabiiLeft) <= most,
                    "the lower lip depressor stays below its bound"
                );
                if matches!(every, "f" | "v") {
                    assert!(controls.bite > 0.89, "{every} {}", controls.bite);
                    assert!(controls.jaw.pitch_rad < 0.07, "{}", controls.jaw.pitch_rad);
                } else {
                    assert!(controls.seal > 0.97, "{every} {}", controls.seal);
                    assert!(
                        contraction_of(&controls, M::LevatorLabiiRight) <= most,
                        "the upper lip levator stays below its bound"
                    );
                    assert!(controls.jaw.pitch_rad < 0.13, "{}", controls.jaw.pitch_rad);
                    // A smile stays, less of it.
                    let smile = contraction_of(&controls, M::ZygomaticusMajorLeft);
                    let felt = noise::unit(
                        seed as u64,
                        M::ZygomaticusMajorLeft.index() as u64,
                        i as i64,
                    );
                    assert!(
                        (0.69 * felt..=0.72 * felt).contains(&smile),
                        "{smile} {felt}"
                    );
                }
            }
        }
    }

    #[test]
    fn without_a_closure_the_sum_is_only_limited() {
        let mut controls = FaceControls {
            contraction: [0.6; MUSCLES],
            ..FaceControls::default()
        };
        controls.contraction[M::MentalisLeft.index()] = 1.7;
        controls.jaw.pitch_rad = 0.3;
        let mut limited = controls;
        limited.limit();
        hold_closures(&mut controls);
        assert_eq!(controls, limited);
    }
}
