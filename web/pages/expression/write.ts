/** A setting as EML. */

import { script, tag } from '../../speech/markup.js';
import type { Setting } from './state.js';

/**
 * Time of the still image, at which playback also starts, seconds: by then the camera has moved, and the mood has followed the emotion (its time constant is
 * 10 s) far enough to choose its music.
 */
export const SHOWN_SECS = 12;
const LENGTH_SECS = 24;
const SPEAKS_SECS = 14;

/** Hands that open to the listener, as in the story *White rabbit*. */
const OPENING = tag('gesture-key', { time: 'said+0.5s', duration: 1.6, handedness: 'both' }, [
  tag('hand-shapes', {}, [tag('key', { time: 0, id: 4 })]),
  tag('palms', {}, [tag('key', { time: 0, a: 90, x: 0.6, y: 0.8, z: 0 })]),
  tag('motion', { coords: 'speaker' }, [tag('key', { time: 0, x: -4, y: 11, z: -10 }), tag('key', { time: 1.1, x: -9, y: 12, z: -13 })]),
]);

/** Returns a complete script: the emotion from the start, and a neutral sentence. */
export function write({ emotion, potential, camera, light, music, set, thesis }: Setting): string {
  const felt = emotion === 'neutral' ? [] : [tag('r:emotion', { time: 0, type: emotion, potential, duration: LENGTH_SECS })];
  const clauses = [...felt, tag('voice-text', { time: SPEAKS_SECS, timeId: 'said' }, ['Now listen to what happened next.']), OPENING, tag('null', { time: LENGTH_SECS })];
  return script('expression', true, clauses, [tag('r:environment', { camera, light, music, set, ...(thesis && { fidelity: 'thesis' }) })]);
}
