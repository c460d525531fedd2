/** Animations go on from where they are when their speed changes, though the text that plays them is written anew. */

import { GROUPS, type State, type Track } from './state.js';

/** How an animation came to where its speed changed last: as if always at one speed until then. */
export interface JointSpeed {
  readonly untilSecs: number;
  readonly speed: number;
}

/** The data of a track. */
interface TrackHistory {
  readonly place: string;
  readonly track: Track;
  readonly clip: string;
  readonly speed: number;
  readonly pace: JointSpeed | undefined;
}

/** The tracks of the player that plays, by their places in it. */
function tracksOf({ mechanism, layers, groups }: State): [string, Track][] {
  if (mechanism === 'layers') return layers.map((track, i) => [`${i}`, track]);
  return mechanism === 'groups' ? GROUPS.map((name) => [name, groups[name]]) : [];
}

/** Earlier than this an animation has gone nowhere yet, seconds. */
const SOON_SECS = 0.05;

/** The paces of all tracks. */
export class JointSpeeds {
  #histories: readonly TrackHistory[] = [];

  constructor(state: State) {
    this.follow(state, 0);
  }

  /**
   * Takes in what the controls say by now: a track that keeps its animation goes on from where this
   * is at `nowSecs` of the script, which goes back only by `restart`.
   */
  follow(state: State, nowSecs: number): void {
    this.#histories = tracksOf(state).map(([place, track]) => {
      // Undo brings other objects back, which stand in the same places.
      const before = this.#histories.find((course) => course.track === track) ?? this.#histories.find((course) => course.place === place);
      const { clip, speed } = track;
      const pace = before?.clip !== clip ? undefined : before.speed === speed ? before.pace : changed(before, nowSecs);
      return { place, track, clip, speed, pace };
    });
  }

  /** How a track came to the speed that it has; undefined when it always had it. */
  of(track: Track): JointSpeed | undefined {
    return this.#histories.find((course) => course.track === track)?.pace;
  }

  /** The script goes on from `nowSecs`: speeds that changed later were never different. True when there were any. */
  restart(nowSecs: number): boolean {
    const later = ({ pace }: TrackHistory): boolean => pace !== undefined && pace.untilSecs > nowSecs;
    if (!this.#histories.some(later)) return false;
    this.#histories = this.#histories.map((course) => (later(course) ? { ...course, pace: undefined } : course));
    return true;
  }
}

function changed({ speed, pace }: TrackHistory, nowSecs: number): JointSpeed | undefined {
  if (nowSecs < SOON_SECS) return undefined;
  const { untilSecs, speed: first } = pace ?? { untilSecs: 0, speed };
  const covered = first * untilSecs + speed * (nowSecs - untilSecs);
  return { untilSecs: nowSecs, speed: covered / nowSecs };
}
