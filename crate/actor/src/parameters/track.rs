//! All control parameters of a performance over time.

use std::sync::Arc;

use raconteur_base::order::sort_by_number;
use raconteur_body::face::FaceControls;
use raconteur_speech::phones::PhoneTargets;

use super::clip::ParameterClip;
use super::control::FaceControl;
use super::curve::{Curve, ParameterChange};
use super::name::{Parameter, ParameterTarget};
use super::script::{ParameterCommand, ParameterScript};
use crate::lips::MouthTargets;

/// Control parameters of a performance, prepared; gives their values at any story time. Evaluation
/// takes O(log n) per parameter in use and allocates nothing.
#[derive(Clone, Debug, Default)]
pub struct ParameterTrack {
    dials: Vec<(FaceControl, Curve)>,
    visemes: Vec<(&'static PhoneTargets, Curve)>,
    emotions: Vec<(&'static str, Curve)>,
}

impl ParameterTrack {
    /// Creates the track from a story's commands. `library` provides animations by name; unknown
    /// names and non-finite times are left out.
    #[must_use]
    pub fn new(
        script: &ParameterScript,
        library: &dyn Fn(&str) -> Option<Arc<ParameterClip>>,
    ) -> Self {
        let mut commands: Vec<&(f64, ParameterCommand)> = script
            .commands
            .iter()
            .filter(|(time_secs, _)| time_secs.is_finite())
            .collect();
        sort_by_number(&mut commands, |(time_secs, _)| *time_secs);
        let mut curves: Vec<Option<Curve>> = vec![None; Parameter::COUNT];
        let mut curve = |parameter: Parameter, act: &dyn Fn(&mut Curve)| {
            let new = || Curve::new(parameter.min_value());
            act(curves[parameter.index()].get_or_insert_with(new));
        };
        for (time_secs, command) in commands {
            let start = *time_secs;
            match command {
                ParameterCommand::Set(parameter, value) => {
                    let value = number(*value);
                    curve(*parameter, &|c| c.push(start, ParameterChange::Ease(value)));
                }
                ParameterCommand::Lead(parameter, adsr) => {
                    let keys = adsr.keys().map(|(at, value)| (start + at, number(value)));
                    curve(*parameter, &|c| c.append_keys(start, &keys));
                }
                ParameterCommand::Play {
                    animation,
                    style,
                    gain,
                } => {
                    let Some(clip) = library(animation) else {
                        continue;
                    };
                    for (place, parameter) in clip.parameters() {
                        let course = || ParameterChange::Clip {
                            clip: Arc::clone(&clip),
                            place,
                            style: *style,
                            gain: number(*gain),
                        };
                        curve(parameter, &|c| c.push(start, course()));
                    }
                }
            }
        }
        let mut track = Self::default();
        for (parameter, curve) in Parameter::all().zip(curves) {
            let Some(curve) = curve else { continue };
            match parameter.target() {
                ParameterTarget::Control(dial) => track.dials.push((dial, curve)),
                ParameterTarget::Viseme(targets) => track.visemes.push((targets, curve)),
                ParameterTarget::Emotion(word) => track.emotions.push((word, curve)),
            }
        }
        track
    }

    /// Adds the values of muscles and direct parameters at a time.
    pub fn add(&self, time_secs: f64, controls: &mut FaceControls) {
        for (dial, curve) in &self.dials {
            dial.add(curve.sample(time_secs), controls);
        }
    }

    /// Returns the turn of the eyes from their usual gaze direction: yaw to the figure's left and
    /// pitch down, radians.
    #[must_use]
    pub fn gaze(&self, time_secs: f64) -> [f64; 2] {
        self.dials.iter().fold([0.0; 2], |[yaw, pitch], (dial, c)| {
            let [more_yaw, more_pitch] = dial.gaze_rad(c.sample(time_secs));
            [yaw + more_yaw, pitch + more_pitch]
        })
    }

    /// Returns the mouth targets of the visemes at a time, weighted; their mean if the total
    /// exceeds full weight. `None` while no viseme is set.
    #[must_use]
    pub fn visemes(&self, time_secs: f64) -> Option<MouthTargets> {
        let mut mouth = MouthTargets::default();
        let mut sum = 0.0;
        for (targets, curve) in &self.visemes {
            let (weight, one) = (curve.sample(time_secs), MouthTargets::from_phone(targets));
            sum += weight;
            for (channel, more) in mouth.channels.iter_mut().zip(one.channels) {
                *channel += weight * more;
            }
            mouth.press += weight * one.press;
            mouth.bite += weight * one.bite;
        }
        if sum > 1.0 {
            mouth.channels.iter_mut().for_each(|c| *c /= sum);
            mouth.press /= sum;
            mouth.bite /= sum;
        }
        (sum > 0.0).then_some(mouth)
    }

    /// Returns the emotions set by name: word and strength over time.
    #[must_use]
    pub fn emotions(&self) -> &[(&'static str, Curve)] {
        &self.emotions
    }
}

/// Returns a finite number, or 0.
fn number(value: f64) -> f64 {
    if value.is_finite() { value } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::script::{Adsr, PlaybackStyle};
    use super::*;
    use raconteur_body::face::Muscle;
    use raconteur_speech::phones::Channel;

    fn none(_: &str) -> Option<Arc<ParameterClip>> {
        None
    }

    fn track(commands: Vec<(f64, ParameterCommand)>) -> ParameterTrack {
        ParameterTrack::new(&ParameterScript { commands }, &none)
    }

    fn one(name: &str) -> Parameter {
        Parameter::named(name).next().expect("a parameter")
    }

    fn asked(track: &ParameterTrack, t: f64) -> FaceControls {
        let mut controls = FaceControls::default();
        track.add(t, &mut controls);
        controls
    }

    #[test]
    fn four_phases_follow_a_table_worked_out_by_hand() {
        // Attack 0.4 s to 1, decay 0.2 s to 0.6, sustain 0.5 s at 0.5, release 0.4 s to 0.1.
        let adsr = Adsr {
            secs: [0.4, 0.2, 0.5, 0.4],
            values: [1.0, 0.6, 0.5, 0.1],
        };
        let track = track(vec![(2.0, ParameterCommand::Lead(one("Jaw"), adsr))]);
        for (t, value) in [
            (1.9, 0.0),
            (2.0, 0.0),
            (2.1, 0.25),
            (2.2, 0.5),
            (2.4, 1.0),
            (2.5, 0.8),
            (2.6, 0.6),
            // The sustain value is reached within a frame of 0.04 s.
            (2.62, 0.55),
            (2.64, 0.5),
            (2.9, 0.5),
            (3.1, 0.5),
            (3.2, 0.4),
            (3.4, 0.2),
            (3.5, 0.1),
            (60.0, 0.1),
        ] {
            let jaw = asked(&track, t).jaw.pitch_rad / 0.35;
            assert!((jaw - value).abs() < 1e-9, "at {t}: {jaw}, not {value}");
        }
    }

    #[test]
    fn of_one_time_the_last_counts_and_order_does_not_matter_else() {
        let lid = one("UpperLidLeft");
        let a = (1.0, ParameterCommand::Set(lid, 0.3));
        let b = (1.0, ParameterCommand::Set(lid, 0.9));
        let c = (2.0, ParameterCommand::Set(lid, -0.4));
        let first = track(vec![a.clone(), b.clone(), c.clone()]);
        let second = track(vec![c, a, b]);
        for i in 0..300 {
            let t = f64::from(i) * 0.01;
            assert_eq!(asked(&first, t), asked(&second, t));
        }
        assert_eq!(asked(&first, 1.5).upper_lid, [0.9, 0.0]);
        assert_eq!(asked(&first, 2.5).upper_lid, [-0.4, 0.0]);
    }

    #[test]
    fn nothing_that_is_set_jumps() {
        let names = ["Jaw", "Blush", "GazeX", "CorrugatorSuperciliiLeft"];
        let mut commands = Vec::new();
        for i in 0..200_i64 {
            let unit = |k| raconteur_base::noise::unit(7, k, i);
            let name = names[(unit(1) * 4.0) as usize % 4];
            let value = 2.0 * unit(2) - 1.0;
            commands.push((8.0 * unit(3), ParameterCommand::Set(one(name), value)));
        }
        let track = track(commands);
        let mut last = asked(&track, 0.0);
        for i in 1..9000 {
            let now = asked(&track, f64::from(i) * 1e-3);
            let corrugator = Muscle::CorrugatorLeft.index();
            for (a, b) in [
                (last.jaw.pitch_rad / 0.35, now.jaw.pitch_rad / 0.35),
                (last.blush, now.blush),
                (last.contraction[corrugator], now.contraction[corrugator]),
            ] {
                // From −1 to 1 in 0.15 s, at 1.5 times the mean speed.
                assert!((a - b).abs() < 2.0 * 1.5 / 150.0 + 1e-9, "{a} {b}");
            }
            last = now;
        }
    }

    #[test]
    fn animations_play_in_their_style_times_their_gain() {
        let clip = ParameterClip::read(
            r#"{"seconds": 1, "parameters": {"Jaw": {"times": [0, 1], "values": [0, 1]}}}"#,
        );
        let clip = Arc::new(clip.expect("a clip"));
        let library = |name: &str| (name == "yawn").then(|| Arc::clone(&clip));
        let play = |style, gain| ParameterCommand::Play {
            animation: "yawn".to_owned(),
            style,
            gain,
        };
        for (style, gain, table) in [
            (
                PlaybackStyle::Forward,
                1.0,
                [(0.5, 0.5), (1.0, 1.0), (3.0, 1.0)],
            ),
            (
                PlaybackStyle::Reverse,
                1.0,
                [(0.5, 0.5), (1.0, 0.0), (3.0, 0.0)],
            ),
            (
                PlaybackStyle::PingPong,
                0.5,
                [(0.5, 0.25), (1.0, 0.5), (1.5, 0.25)],
            ),
            (
                PlaybackStyle::ReversePingPong,
                1.0,
                [(0.5, 0.5), (1.0, 0.0), (1.75, 0.75)],
            ),
            (
                PlaybackStyle::Forward,
                4.0,
                [(0.2, 0.8), (0.5, 1.0), (3.0, 1.0)],
            ),
        ] {
            let script = ParameterScript {
                commands: vec![(5.0, play(style, gain))],
            };
            let track = ParameterTrack::new(&script, &library);
            for (since, value) in table {
                let jaw = asked(&track, 5.0 + since).jaw.pitch_rad / 0.35;
                assert!((jaw - value).abs() < 1e-9, "{style:?} {since}: {jaw}");
            }
        }
    }

    #[test]
    fn visemes_are_mixed_by_weight() {
        let set = |name: &str, value| (0.0, ParameterCommand::Set(one(name), value));
        let half = track(vec![set("aa", 0.5)]);
        assert_eq!(half.visemes(-1.0), None);
        let mouth = half.visemes(1.0).expect("a mouth");
        assert!(
            (mouth.channel(Channel::Jaw) - 0.325).abs() < 1e-12,
            "half a viseme opens the jaw by half"
        );
        let shut = track(vec![set("PP", 1.0)]).visemes(1.0).expect("a mouth");
        assert_eq!((shut.press, shut.channel(Channel::LipOpen)), (1.0, 0.0));
        let both = track(vec![set("aa", 1.0), set("FF", 1.0)]);
        let mouth = both.visemes(1.0).expect("a mouth");
        assert!(
            (mouth.bite - 0.5).abs() < 1e-12,
            "the mean bite of both visemes"
        );
        assert!(
            (mouth.channel(Channel::Jaw) - 0.375).abs() < 1e-12,
            "the weighted jaw opening"
        );
    }

    #[test]
    fn what_is_no_number_does_nothing() {
        let track = track(vec![
            (f64::NAN, ParameterCommand::Set(one("Jaw"), 1.0)),
            (1.0, ParameterCommand::Set(one("Blush"), f64::NAN)),
            (
                1.0,
                ParameterCommand::Lead(
                    one("LipSeal"),
                    Adsr {
                        secs: [f64::INFINITY, -1.0, f64::NAN, 0.1],
                        values: [f64::NAN; 4],
                    },
                ),
            ),
        ]);
        assert_eq!(asked(&track, 2.0), FaceControls::default());
    }
}
