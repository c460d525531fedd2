//! Commands of a story to control parameters (GEVH D.3.27 to D.3.30).

use super::name::Parameter;

/// Direction in which an animation of control parameters plays.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PlaybackStyle {
    /// Plays from beginning to end.
    #[default]
    Forward,
    /// Plays from end to beginning.
    Reverse,
    /// Forward, then back.
    PingPong,
    /// Back, then forward.
    ReversePingPong,
}

impl PlaybackStyle {
    /// Returns the position in an animation of a given length, some seconds after playback began;
    /// it stays at the end.
    #[must_use]
    pub fn place(self, since_secs: f64, length_secs: f64) -> f64 {
        let there = since_secs.clamp(0.0, length_secs);
        let back = (since_secs - length_secs).clamp(0.0, length_secs);
        match self {
            Self::Forward => there,
            Self::Reverse => length_secs - there,
            Self::PingPong => there - back,
            Self::ReversePingPong => length_secs - there + back,
        }
    }
}

/// Envelope of a parameter in four linear phases (GEVH D.3.28): to the attack value, to the decay
/// value, the sustain value held, and to the release value, which remains.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Adsr {
    /// Duration of each phase, seconds: attack, decay, sustain, release.
    pub secs: [f64; 4],
    /// The value of each.
    pub values: [f64; 4],
}

impl Adsr {
    /// Returns the values with the times at which they are reached, seconds from the start. Invalid
    /// durations count as 0.
    pub(super) fn keys(&self) -> [(f64, f64); 5] {
        let mut sum = 0.0;
        let ends = self.secs.map(|secs| {
            if secs.is_finite() {
                sum += secs.max(0.0);
            }
            sum
        });
        let [attack, decay, sustain, release] = self.values;
        [
            (ends[0], attack),
            (ends[1], decay),
            (ends[1], sustain),
            (ends[2], sustain),
            (ends[3], release),
        ]
    }
}

/// Command of a script to the control parameters: set a value, follow an envelope, or play an
/// animation.
#[derive(Clone, Debug, PartialEq)]
pub enum ParameterCommand {
    /// Sets a parameter to a value.
    Set(Parameter, f64),
    /// Moves a parameter through four phases.
    Lead(Parameter, Adsr),
    /// An animation plays.
    Play {
        /// Name of the animation in the library.
        animation: String,
        /// Direction of playback.
        style: PlaybackStyle,
        /// Factor for its values.
        gain: f64,
    },
}

/// Timed commands that set control parameters of the face (GEVH D.3.27). Commands may be in any
/// order; of simultaneous ones the last in the list counts.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ParameterScript {
    /// Commands with their story times, seconds.
    pub commands: Vec<(f64, ParameterCommand)>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn styles_lead_through_an_animation() {
        let at = |style: PlaybackStyle| [-1.0, 0.5, 2.0, 3.5, 9.0].map(|t| style.place(t, 2.0));
        assert_eq!(at(PlaybackStyle::Forward), [0.0, 0.5, 2.0, 2.0, 2.0]);
        assert_eq!(at(PlaybackStyle::Reverse), [2.0, 1.5, 0.0, 0.0, 0.0]);
        assert_eq!(at(PlaybackStyle::PingPong), [0.0, 0.5, 2.0, 0.5, 0.0]);
        assert_eq!(
            at(PlaybackStyle::ReversePingPong),
            [2.0, 1.5, 0.0, 1.5, 2.0]
        );
        assert_eq!(PlaybackStyle::PingPong.place(3.0, 0.0), 0.0);
    }
}
