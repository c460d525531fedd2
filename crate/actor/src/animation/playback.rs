//! Mapping from the played time to the time in a clip.

/// Playback mode of an animation: direction and number of repetitions (GEVH D.3.18).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Playback {
    /// Repeats forwards without end.
    #[default]
    Loop,
    /// Repeats backwards without end.
    LoopReverse,
    /// Forwards and backwards in turn.
    PingPong,
    /// Plays a number of times, then holds its end.
    Iterations(u32),
    /// Plays backwards a number of times, then holds its beginning.
    IterationsReverse(u32),
    /// Plays a number of times, then leaves the stack.
    TemporaryIterations(u32),
    /// Plays backwards a number of times, then leaves the stack.
    TemporaryIterationsReverse(u32),
}

/// Playback position in a clip, seconds from its beginning, with the blend across the seam of a
/// repetition.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ClipTime {
    pub(crate) at_secs: f64,
    /// End time of the previous pass, and its remaining share: a clip whose end does not meet its
    /// beginning is cross-faded.
    pub(crate) seam: Option<(f64, f64)>,
}

/// Longest time in which a clip that is not closed eases from its end to its beginning,
/// seconds, and the most of its length. Designed.
const SEAM_SECS: f64 = 0.35;
const SEAM_SHARE: f64 = 0.4;

impl Playback {
    /// Returns the number of passes; `None` for endless playback.
    #[must_use]
    pub fn iterations(self) -> Option<u32> {
        match self {
            Self::Loop | Self::LoopReverse | Self::PingPong => None,
            Self::Iterations(n)
            | Self::IterationsReverse(n)
            | Self::TemporaryIterations(n)
            | Self::TemporaryIterationsReverse(n) => Some(n.max(1)),
        }
    }

    /// Returns true if the animation leaves the stack when its passes are over.
    #[must_use]
    pub fn is_temporary(self) -> bool {
        matches!(
            self,
            Self::TemporaryIterations(_) | Self::TemporaryIterationsReverse(_)
        )
    }

    fn is_reverse(self) -> bool {
        matches!(
            self,
            Self::LoopReverse | Self::IterationsReverse(_) | Self::TemporaryIterationsReverse(_)
        )
    }

    /// Returns the position in a clip of a given length after `played_secs` of playback; a negative
    /// speed runs backwards.
    pub(crate) fn place(self, played_secs: f64, length_secs: f64, closed: bool) -> ClipTime {
        let still = |at_secs| ClipTime {
            at_secs,
            seam: None,
        };
        if length_secs <= 0.0 {
            return still(0.0);
        }
        if self == Self::PingPong {
            let there = played_secs.rem_euclid(2.0 * length_secs);
            return still(there.min(2.0 * length_secs - there));
        }
        let turned = |at: f64| {
            if self.is_reverse() {
                length_secs - at
            } else {
                at
            }
        };
        let ahead = played_secs >= 0.0;
        let passes = (played_secs.abs() / length_secs).floor();
        if let Some(n) = self.iterations() {
            if !ahead {
                return still(turned(0.0));
            }
            if passes >= f64::from(n) {
                return still(turned(length_secs));
            }
        }
        // Backward playback enters a pass at its end and comes from the beginning of another.
        let into = played_secs.abs().rem_euclid(length_secs);
        let (at, left) = if ahead {
            (into, length_secs)
        } else {
            (length_secs - into, 0.0)
        };
        let seam_secs = SEAM_SECS.min(SEAM_SHARE * length_secs);
        let another = passes >= 1.0 || !ahead;
        let seam = (!closed && another && into < seam_secs).then(|| {
            let s = raconteur_base::curve::minimum_jerk(into / seam_secs);
            (turned(left), 1.0 - s)
        });
        ClipTime {
            at_secs: turned(at),
            seam,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn places(style: Playback) -> Vec<f64> {
        let times = [0.0, 0.5, 1.0, 2.25, 4.25, 6.5];
        times.map(|t| style.place(t, 2.0, true).at_secs).to_vec()
    }

    #[test]
    fn each_style_plays_as_its_name_says() {
        assert_eq!(places(Playback::Loop), [0.0, 0.5, 1.0, 0.25, 0.25, 0.5]);
        assert_eq!(
            places(Playback::LoopReverse),
            [2.0, 1.5, 1.0, 1.75, 1.75, 1.5]
        );
        assert_eq!(places(Playback::PingPong), [0.0, 0.5, 1.0, 1.75, 0.25, 1.5]);
        for style in [Playback::Iterations(2), Playback::TemporaryIterations(2)] {
            assert_eq!(places(style), [0.0, 0.5, 1.0, 0.25, 2.0, 2.0]);
        }
        for style in [
            Playback::IterationsReverse(2),
            Playback::TemporaryIterationsReverse(2),
        ] {
            assert_eq!(places(style), [2.0, 1.5, 1.0, 1.75, 0.0, 0.0]);
        }
        // The minimum is one iteration, and a stance has one position.
        assert_eq!(Playback::Iterations(0).iterations(), Some(1));
        assert_eq!(Playback::Loop.place(3.0, 0.0, true).at_secs, 0.0);
        assert_eq!(Playback::Iterations(1).place(-1.0, 2.0, true).at_secs, 0.0);
    }

    #[test]
    fn an_open_clip_eases_over_its_seam() {
        let style = Playback::Loop;
        assert_eq!(style.place(0.1, 2.0, false).seam, None);
        let at = |t| style.place(t, 2.0, false).seam;
        assert_eq!(at(2.0), Some((2.0, 1.0)));
        assert!(
            at(2.1).is_some_and(|(end, share)| end == 2.0 && share > 0.5 && share < 1.0),
            "the seam blends into the end of the clip"
        );
        assert_eq!(at(2.4), None);
        assert_eq!(style.place(2.0, 2.0, true).seam, None);
        // Backwards, too: from the beginning over to the end.
        let back = |t| style.place(t, 2.0, false);
        assert_eq!((back(-0.5).at_secs, back(-0.5).seam), (1.5, None));
        let (place, seam) = (back(-2.0), back(-2.0).seam);
        assert_eq!((place.at_secs, seam), (2.0, Some((0.0, 1.0))));
        assert!(
            back(-1e-9)
                .seam
                .is_some_and(|(at, share)| at == 0.0 && share > 0.99),
            "backward playback blends at the start of the clip"
        );
    }
}
