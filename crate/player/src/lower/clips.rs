//! Space required by animations of the whole body.

use raconteur_actor::Library;
use raconteur_actor::animation::{Operation, PlayerCommand};
use raconteur_stage::{Gesture, TakenSpace};

/// Displacement of the figure, share of stature, from which an animation is framed as a whole.
/// Designed: a nod or a shift of weight stays below it.
const SMALL_WAY: f64 = 0.03;

/// Returns the image space that commands of animation players need, and its times. `commands` are
/// in any order, with their times in seconds.
pub(crate) fn spaces(
    commands: &[(f64, PlayerCommand)],
    library: &Library,
    stature_m: f64,
) -> Vec<Gesture> {
    let space = TakenSpace::of_body(stature_m);
    commands
        .iter()
        .filter_map(|(time_secs, command)| {
            let PlayerCommand::Operate { operation, .. } = command else {
                return None;
            };
            let (Operation::Push(name, playback) | Operation::Exchange(name, playback)) = operation
            else {
                return None;
            };
            let clip = library.get(name).filter(|c| c.travel() > SMALL_WAY)?;
            let passes = playback.iterations().filter(|_| playback.is_temporary());
            let lasts_secs = passes.map_or(f64::INFINITY, |n| f64::from(n) * clip.duration_secs());
            Some(Gesture {
                from_secs: *time_secs,
                to_secs: (time_secs + lasts_secs).min(next_change(commands, *time_secs)),
                space,
            })
        })
        .collect()
}

/// Returns the time of the next change of the playback after a time, seconds; infinite without such
/// a command.
fn next_change(commands: &[(f64, PlayerCommand)], time_secs: f64) -> f64 {
    commands
        .iter()
        .filter(|(t, command)| {
            let changes = matches!(
                command,
                PlayerCommand::Operate { .. } | PlayerCommand::Remove { .. } | PlayerCommand::Clear
            );
            changes && *t > time_secs
        })
        .map(|(t, _)| *t)
        .fold(f64::INFINITY, f64::min)
}

#[cfg(test)]
mod tests {
    use raconteur_actor::animation::Playback;

    use super::*;

    const LEAP: &str = r#"{"seconds": 2, "loop": true,
        "tracks": {"root": {"times": [0, 1], "left": [0, 20], "up": 0, "front": 0}}}"#;
    const NOD: &str =
        r#"{"seconds": 1, "tracks": {"chest": {"times": [0, 1], "flexion": [0, 5]}}}"#;

    fn push(name: &str, playback: Playback) -> PlayerCommand {
        PlayerCommand::Operate {
            player: None,
            tracks: None,
            operation: Operation::Push(name.to_owned(), playback),
        }
    }

    fn spans(commands: &[(f64, PlayerCommand)]) -> Vec<[f64; 2]> {
        let mut library = Library::default();
        library.add("leap", LEAP).expect("a clip");
        library.add("nod", NOD).expect("a clip");
        spaces(commands, &library, 1.7)
            .iter()
            .map(|g| [g.from_secs, g.to_secs])
            .collect()
    }

    #[test]
    fn what_takes_the_figure_away_is_seen_whole_until_something_else_plays() {
        let twice = Playback::TemporaryIterations(2);
        let leaps = [
            (1.0, push("leap", Playback::Loop)),
            (9.0, push("nod", Playback::Loop)),
        ];
        assert_eq!(spans(&leaps), [[1.0, 9.0]]);
        assert_eq!(spans(&leaps[..1]), [[1.0, f64::INFINITY]]);
        assert_eq!(spans(&[(3.0, push("leap", twice))]), [[3.0, 7.0]]);
        assert_eq!(spans(&[(3.0, push("nowhere", twice))]), [[0.0; 2]; 0]);
    }
}
