/** Continuity of animations across speed changes, although the text that plays them is rewritten. */

import { GROUPS, type State, type Track } from './state.js';

/** History of an animation up to its last speed change, as if played at a constant speed until then. */
export interface SpeedChange {
  readonly untilSecs: number;
  readonly speed: number;
}

/** The data of a track. */
interface TrackHistory {
  readonly place: string;
  readonly track: Track;
  readonly clip: string;
  readonly speed: number;
  readonly pace: SpeedChange | undefined;
}

/** Returns the tracks of the active player, by position. */
function tracksOf({ mechanism, layers, groups }: State): [string, Track][] {
  if (mechanism === 'layers') return layers.map((track, i) => [`${i}`, track]);
  return mechanism === 'groups' ? GROUPS.map((name) => [name, groups[name]]) : [];
}

/** Earlier than this an animation has gone nowhere yet, seconds. */
const SOON_SECS = 0.05;

/** The paces of all tracks. */
export class SpeedHistory {
  #histories: readonly TrackHistory[] = [];

  constructor(state: State) {
    this.follow(state, 0);
  }

  /**
   * Updates from the current controls: a track with the same animation continues from its position at `nowSecs` of the script, which goes back only by
   * `restart`.
   */
  follow(state: State, nowSecs: number): void {
    this.#histories = tracksOf(state).map(([place, track]) => {
      // Undo restores other objects at the same positions.
      const before = this.#histories.find((course) => course.track === track) ?? this.#histories.find((course) => course.place === place);
      const { clip, speed } = track;
      const pace = before?.clip !== clip ? undefined : before.speed === speed ? before.pace : changed(before, nowSecs);
      return { place, track, clip, speed, pace };
    });
  }

  /** Returns the pace of a track; undefined if its speed never changed. */
  of(track: Track): SpeedChange | undefined {
    return this.#histories.find((course) => course.track === track)?.pace;
  }

  /** Restarts the script from `nowSecs` and discards later speed changes. Returns true if there were any. */
  restart(nowSecs: number): boolean {
    const later = ({ pace }: TrackHistory): boolean => pace !== undefined && pace.untilSecs > nowSecs;
    if (!this.#histories.some(later)) return false;
    this.#histories = this.#histories.map((course) => (later(course) ? { ...course, pace: undefined } : course));
    return true;
  }
}

function changed({ speed, pace }: TrackHistory, nowSecs: number): SpeedChange | undefined {
  if (nowSecs < SOON_SECS) return undefined;
  const { untilSecs, speed: first } = pace ?? { untilSecs: 0, speed };
  const covered = first * untilSecs + speed * (nowSecs - untilSecs);
  return { untilSecs: nowSecs, speed: covered / nowSecs };
}
