/** Movement of the edges of annotations. Edges that coincide move together, and no annotation gets over its neighbour. */

import { annotationsOf, timedAt } from './tracks.js';
import type { Item, Timed, Transcription } from './types.js';

export type Side = 'start' | 'end';

/** Difference of times that are the same, seconds. */
const SAME_SECS = 0.0005;
/** Minimum length of an annotation, seconds: a hundredth, to which GestuRA gives times. */
export const MIN_SECS = 0.01;

interface Edge {
  readonly list: readonly Timed[];
  readonly index: number;
  readonly side: Side;
}

const opposite = (side: Side): Side => (side === 'start' ? 'end' : 'start');

/** Returns the neighbour that an edge faces. */
const facing = ({ list, index, side }: Edge): Edge => ({ list, index: side === 'end' ? index + 1 : index - 1, side: opposite(side) });

const annotation = ({ list, index }: Edge): Timed | undefined => list[index];

const isSame = (a: Edge, b: Edge): boolean => a.list === b.list && a.index === b.index && a.side === b.side;

/** Edges that are moved together from one position to others. */
export interface Grip {
  /** Moves the edges to a time, as far as the neighbours allow; returns true if they moved. */
  move(secs: number): boolean;
}

/**
 * Takes hold of an edge of an annotation; undefined if it cannot move. The border shared with a neighbour moves along, as do the edges of the gesture whose
 * phases begin or end there, and those of the phases of a gesture. An edge of an utterance or another run of annotations is that of its first or last part.
 * What an edge meets on its way does not stick to it.
 */
export function grip(transcription: Transcription, item: Item, side: Side): Grip | undefined {
  const { track, index } = timedAt(transcription, item, side);
  const list = annotationsOf(transcription, track) as Timed[];
  const held = list[index];
  if (held === undefined) return undefined;
  const moving = linked(transcription, { list, index, side });
  const { least, most } = limits(moving);
  if (least > most) return undefined;
  return {
    move(secs) {
      // Times are kept to a tenth of a millisecond, so that sums of steps stay short.
      const to = Math.round(Math.min(most, Math.max(least, secs)) * 1e4) / 1e4;
      if (!Number.isFinite(to) || to === held[side]) return false;
      for (const edge of moving) {
        const moved = annotation(edge);
        if (moved !== undefined) moved[edge.side] = to;
      }
      return true;
    },
  };
}

/** Returns the edges that coincide with one and move with it. */
function linked(transcription: Transcription, first: Edge): Edge[] {
  const { gestures, layers } = transcription;
  const phases: Timed[][] = layers.map((layer) => layer.phases);
  const found = [first];
  for (const edge of found) {
    const at = annotation(edge)?.[edge.side];
    if (at === undefined) continue;
    const add = (other: Edge): void => {
      const there = annotation(other)?.[other.side];
      if (there !== undefined && Math.abs(there - at) < SAME_SECS && !found.some((known) => isSame(known, other))) found.push(other);
    };
    add(facing(edge));
    const others = edge.list === gestures ? phases : phases.some((list) => list === edge.list) ? [gestures] : [];
    for (const list of others) list.forEach((_, index) => add({ list, index, side: edge.side }));
  }
  return found;
}

/** Returns the range in which edges may move together. */
function limits(moving: readonly Edge[]): { least: number; most: number } {
  let [least, most] = [0, Infinity];
  for (const edge of moving) {
    const own = annotation(edge);
    if (own === undefined) continue;
    if (edge.side === 'end') least = Math.max(least, own.start + MIN_SECS);
    else most = Math.min(most, own.end - MIN_SECS);
    const other = facing(edge);
    const neighbour = annotation(other)?.[other.side];
    // Gestures may overlap; those that do are not each other's limit.
    if (neighbour === undefined || moving.some((known) => isSame(known, other))) continue;
    if (edge.side === 'end' && neighbour >= own.end) most = Math.min(most, neighbour);
    else if (edge.side === 'start' && neighbour <= own.start) least = Math.max(least, neighbour);
  }
  return { least, most };
}
