//! Share of time of the rest postures.

use raconteur_actor::gesture::RestSpot;
use raconteur_base::Side;

use super::Measure;
use super::recording::Recording;
use crate::Player;

/// Returns the share of the arms' time that each rest posture of one arm takes, percent.
pub(super) fn measures(player: &Player, recording: &Recording) -> Vec<Measure> {
    let mut counts = [0.0_f64; RestSpot::ALL.len()];
    for sample in 0..recording.len() {
        let time_secs = recording.time_secs(sample);
        for side in Side::BOTH {
            if let Some(spot) = player.rest_spot(side, time_secs) {
                counts[spot as usize] += 1.0;
            }
        }
    }
    let all = 2.0 * recording.len() as f64;
    let shares = RestSpot::ALL.into_iter().map(|spot| {
        let share = (all > 0.0).then(|| 1e2 * counts[spot as usize] / all);
        Measure::new(format!("rest-{}", spot.name()), "%", share)
    });
    shares.collect()
}
