/** Delay of a script whose first gesture begins before the hands can be there. */

/** Time allowed for an arm to reach a first stroke (`RUN_UP_SECS` in `crate/player/src/lower/script.rs`): earlier strokes are delayed. */
const RUN_UP_SECS = 0.9;

/** Returns the delay of the player relative to the times of a text, by the start of its first gesture. */
export function delayOf(firstGestureSecs: number): number {
  return Math.max(0, RUN_UP_SECS - firstGestureSecs);
}
