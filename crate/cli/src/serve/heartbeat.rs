//! Detection of lost connections.

use std::time::{Duration, Instant};

/// Keep-alive monitor of one connection: it requests a ping after a silence and the end after a
/// longer one, so that dead connections do not occupy a slot.
pub(crate) struct Heartbeat {
    heard: Instant,
    asked: bool,
    idle: Duration,
}

/// Action due for a connection: none, ping or disconnect.
#[derive(Debug, PartialEq, Eq)]
pub(crate) enum HeartbeatAction {
    /// No action.
    Steady,
    /// Send a ping; once a silence.
    Ask,
    /// End the connection.
    Dead,
}

impl Heartbeat {
    /// Creates a monitor; a connection silent for `idle` is dead, and a ping is sent after a third
    /// of it.
    pub(crate) fn new(idle: Duration, now: Instant) -> Self {
        Self {
            heard: now,
            asked: false,
            idle,
        }
    }

    /// Records received data.
    pub(crate) fn record_activity(&mut self, now: Instant) {
        self.heard = now;
        self.asked = false;
    }

    /// Returns the action that is due at `now`.
    pub(crate) fn beat(&mut self, now: Instant) -> HeartbeatAction {
        let silent = now.saturating_duration_since(self.heard);
        if silent >= self.idle {
            HeartbeatAction::Dead
        } else if silent >= self.idle / 3 && !self.asked {
            self.asked = true;
            HeartbeatAction::Ask
        } else {
            HeartbeatAction::Steady
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// For any times of messages and checks: no connection that sent within the time is dead,
        /// and every other one is; one silence gets one ping, before its end.
        #[test]
        fn who_is_heard_lives(steps in prop::collection::vec((0_u64..60, any::<bool>()), 1..100)) {
            let begin = Instant::now();
            let idle = Duration::from_secs(90);
            let mut pulse = Heartbeat::new(idle, begin);
            let (mut now, mut heard, mut asked) = (begin, begin, 0);
            for (secs, speaks) in steps {
                now += Duration::from_secs(secs);
                if speaks {
                    pulse.record_activity(now);
                    (heard, asked) = (now, 0);
                }
                let silent = now - heard;
                let beat = pulse.beat(now);
                prop_assert_eq!(beat == HeartbeatAction::Dead, silent >= idle);
                asked += u32::from(beat == HeartbeatAction::Ask);
                prop_assert!(asked <= 1 && (asked == 1 || silent < idle / 3 || beat == HeartbeatAction::Dead));
            }
        }
    }
}
