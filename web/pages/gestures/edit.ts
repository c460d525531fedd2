/** Text edits that change the values of gestures. Everything else in the text is unchanged. */

import {
  EXTENSIONS,
  FEATURES,
  mirror,
  mirrored,
  TRACK_NAMES,
  trackOf,
  type Course,
  type Feature,
  type Gesture,
  type Hand,
  type Key,
  type Phase,
  type PhaseName,
  type Track,
  type Value,
} from './gesture.js';
import { attribute, insertInto, removeElement, setAttribute, type Change, type Element } from '../source.js';

/** Formats a number for people: with at most this many decimals, without trailing zeros. */
export const written = (value: number, decimals = 2): string => {
  const text = String(Number(value.toFixed(decimals)));
  return text === '-0' ? '0' : text;
};

/** Hands used in a phase: right, left, both equally, or each separately. */
export type Handedness = 'right' | 'left' | 'both' | 'apart';

/** Returns the prefix of the extensions, and the change that declares it if the text does not. */
function bound({ root, prefix }: Gesture): { prefix: string; changes: Change[] } {
  if (prefix !== undefined || root === undefined) return { prefix: prefix ?? 'r', changes: [] };
  return { prefix: 'r', changes: setAttribute(root, 'xmlns:r', EXTENSIONS) };
}

function setExtension(gesture: Gesture, element: Element, values: Readonly<Record<string, string | undefined>>): Change[] {
  if (Object.values(values).every((value) => value === undefined) && gesture.prefix === undefined) return [];
  const { prefix, changes } = bound(gesture);
  return [...changes, ...setAttributes(element, Object.fromEntries(Object.entries(values).map(([name, value]) => [`${prefix}:${name}`, value])))];
}

/** Returns the changes that set several attributes of one element; new attributes follow each other in this order. */
function setAttributes(element: Element, values: Readonly<Record<string, string | undefined>>): Change[] {
  const changes = Object.entries(values).flatMap(([name, value]) => setAttribute(element, name, value));
  const added = changes.filter((c) => c.from === c.to);
  const first = added[0];
  if (first === undefined) return changes;
  return [...changes.filter((c) => c.from !== c.to), { ...first, insert: added.map((c) => c.insert).join('') }];
}

/** Returns the markup of a key. */
function keyMarkup(prefix: string, time: string | undefined, value: Value): string {
  return `<key${time === undefined ? '' : ` time="${time}"`}${Object.entries(attributesOf(value, prefix))
    .map(([name, v]) => (v === undefined ? '' : ` ${name}="${v}"`))
    .join('')}/>`;
}

function attributesOf(value: Value, prefix: string): Record<string, string | undefined> {
  const { shape, palm, place } = value;
  if (shape !== undefined) {
    const mixed = shape.second !== undefined;
    return { id: String(shape.id), [`${prefix}:id2`]: mixed ? String(shape.second) : undefined, [`${prefix}:weight`]: mixed ? written(shape.weight) : undefined };
  }
  if (palm !== undefined) {
    const [x, y, z] = palm.normal;
    return { a: written(palm.angle, 1), x: written(x, 3), y: written(y, 3), z: written(z, 3) };
  }
  if (place !== undefined) {
    const [x, y, z] = place;
    return { x: written(x, 1), y: written(y, 1), z: written(z, 1) };
  }
  return {};
}

/** Sets the value of keys. */
export function setValue(gesture: Gesture, keys: readonly Key[], value: Value): Change[] {
  const needs = value.shape?.second !== undefined;
  const { prefix, changes } = needs ? bound(gesture) : { prefix: gesture.prefix ?? 'r', changes: [] };
  return [...changes, ...keys.flatMap((key) => setAttributes(key.element, attributesOf(value, prefix)))];
}

/** Sets the time of a key, seconds after the start of its phase, in its existing notation. */
export function setKeyTime(phase: Phase, key: Key, secs: number): Change[] {
  const kept = Math.min(phase.durationSecs, Math.max(0, secs));
  const time = key.written === 'percent' && phase.durationSecs > 0 ? `${written((100 * kept) / phase.durationSecs, 1)}%` : written(kept);
  // Placed before the other attributes, at the usual position.
  if (key.written !== 'nothing') return setAttribute(key.element, 'time', time);
  const at = key.element.from + 1 + key.element.name.length;
  return [{ from: at, to: at, insert: ` time="${time}"` }];
}

/** Adds a key, and a track if the hand has none. */
export function addKey(text: string, gesture: Gesture, phase: Phase, feature: Feature, hand: Hand, secs: number, value: Value, apart: boolean): Change[] {
  const track = trackOf(phase, feature, hand);
  const { prefix, changes } = value.shape?.second === undefined ? { prefix: gesture.prefix ?? 'r', changes: [] } : bound(gesture);
  const key = keyMarkup(prefix, written(secs), track !== undefined && mirrored(phase, track, hand) ? mirror(value) : value);
  if (track === undefined) {
    const own = apart ? ` hand="${hand}"` : '';
    const before = phase.tracks.find((t) => FEATURES.indexOf(t.feature) > FEATURES.indexOf(feature));
    const name = TRACK_NAMES[feature];
    return [...changes, insertInto(text, phase.element, `<${name}${own}>\n  ${key}\n</${name}>`, before?.element)];
  }
  // The other keys keep their implicit times.
  const others = track.keys.filter((k) => k.written === 'nothing').flatMap((k) => setKeyTime(phase, k, k.secs));
  const next = track.keys.find((k) => k.secs > secs + 1e-6);
  return [...changes, ...others, insertInto(text, track.element, key, next?.element)];
}

/** Removes a key, and its track with the last one. */
export function removeKey(text: string, phase: Phase, track: Track, key: Key): Change[] {
  if (track.keys.length === 1) return [removeElement(text, track.element)];
  const others = track.keys.filter((k) => k !== key && k.written === 'nothing').flatMap((k) => setKeyTime(phase, k, k.secs));
  return [...others, removeElement(text, key.element)];
}

/** Sets the timing curve of a key, or of a track whose keys have none of their own. */
export function setCourse(gesture: Gesture, of: Key | Track, course: Course | undefined): Change[] {
  return setExtension(gesture, of.element, {
    interpolation: course?.kind,
    controls: course === undefined || course.controls.length === 0 ? undefined : course.controls.map((c) => written(c)).join(' '),
  });
}

export const setSpace = (gesture: Gesture, track: Track, space: Track['space']): Change[] => setExtension(gesture, track.element, { space });

export const setPhase = (gesture: Gesture, phase: Phase, name: PhaseName | undefined): Change[] => setExtension(gesture, phase.element, { phase: name });

/** Sets the length of a phase; keys in seconds keep their share of it. */
export function setDuration(phase: Phase, secs: number): Change[] {
  const duration = Math.max(0.05, secs);
  const ratio = phase.durationSecs > 0 ? duration / phase.durationSecs : 1;
  const keys = phase.tracks.flatMap((t) => t.keys).filter((k) => k.written === 'seconds');
  return [...setAttribute(phase.element, 'duration', written(duration)), ...keys.flatMap((k) => setAttribute(k.element, 'time', written(k.secs * ratio, 3)))];
}

/** Sets when a phase begins: in a `seq` the pause before it, else the time from the start. Only for plain times. */
export function setStart(phase: Phase, secs: number): Change[] {
  return setAttribute(phase.element, 'time', written(Math.max(0, secs)));
}

/** Returns true if a phase automatically follows the previous one. */
export const inSequence = (phase: Phase): boolean => phase.element.parent?.name === 'seq';

/** Returns its own `time` in plain seconds; undefined for an expression with names. */
export function ownTime(phase: Phase): number | undefined {
  const time = attribute(phase.element, 'time') ?? '0';
  return /^\s*(\d+\.?\d*|\.\d+)s?\s*$/.test(time) ? Number.parseFloat(time) : undefined;
}

/** Changes the hands of a phase. Movements of the right hand are mirrored for the left, and vice versa. */
export function setHands(text: string, gesture: Gesture, phase: Phase, wanted: Handedness): Change[] {
  const { prefix } = gesture;
  const changes = setAttribute(phase.element, 'handedness', wanted === 'apart' ? 'both' : wanted);
  // Hand whose tracks are the pattern for the new ones.
  const pattern: Hand = phase.hands === 'left' ? 'left' : 'right';
  for (const feature of FEATURES) {
    const tracks = phase.tracks.filter((t) => t.feature === feature);
    if (wanted === 'apart') {
      const common = tracks.find((t) => t.hand === undefined);
      if (common === undefined) continue;
      // A hand without a track of its own mirrors the track of the other hand.
      changes.push(...setAttribute(common.element, 'hand', pattern));
      const other: Hand = pattern === 'right' ? 'left' : 'right';
      if (!tracks.some((t) => t.hand === other)) changes.push(copyTrack(text, phase, common, other, prefix));
      continue;
    }
    const source =
      wanted === 'both'
        ? (trackOf({ ...phase, hands: 'both' }, feature, pattern) ?? tracks[0])
        : (tracks.find((t) => t.hand === wanted) ?? tracks.find((t) => t.hand === undefined) ?? tracks[0]);
    if (source === undefined) continue;
    const saidFor: Hand = source.hand ?? pattern;
    const meantFor: Hand = wanted === 'both' ? 'right' : wanted;
    changes.push(...setAttribute(source.element, 'hand', undefined));
    if (saidFor !== meantFor) changes.push(...source.keys.flatMap((k) => setAttributes(k.element, attributesOf(mirror(k.value), prefix ?? 'r'))));
    for (const track of tracks) if (track !== source) changes.push(removeElement(text, track.element));
  }
  return changes;
}

/** Copies a track to the other hand, mirrored; its other attributes are preserved. */
function copyTrack(text: string, phase: Phase, track: Track, hand: Hand, prefix: string | undefined): Change {
  const { element } = track;
  const keep = (e: Element, drop: readonly string[]) =>
    e.attributes
      .filter((a) => !drop.includes(a.name))
      .map((a) => ` ${text.slice(a.from, a.to)}`)
      .join('');
  const keys = track.keys.map((key) => {
    const values = attributesOf(mirror(key.value), prefix ?? 'r');
    const own = Object.entries(values)
      .map(([name, value]) => (value === undefined ? '' : ` ${name}="${value}"`))
      .join('');
    return `  <key${keep(key.element, Object.keys(values))}${own}/>`;
  });
  const following = phase.element.children[phase.element.children.indexOf(element) + 1];
  return insertInto(text, phase.element, `<${element.name} hand="${hand}"${keep(element, ['hand'])}>\n${keys.join('\n')}\n</${element.name}>`, following);
}

/** Adds a phase after another, or at the end of the body; `like` provides its hands. */
export function addPhase(text: string, gesture: Gesture, name: PhaseName, after: Phase | undefined): Change[] {
  const { body } = gesture;
  const { prefix, changes } = bound(gesture);
  const parent = after?.element.parent ?? body;
  if (parent === undefined) return [];
  const durations: Record<PhaseName, string> = { preparation: '0.5', prestroke: '0.3', stroke: '0.6', poststroke: '0.4', retraction: '0.7', 'partial-retraction': '0.5' };
  const start = after === undefined || inSequence(after) ? '0' : written((after.startSecs ?? 0) + after.durationSecs);
  const hands = after?.hands ?? 'right';
  const markup = `<gesture-key time="${start}" duration="${durations[name]}" handedness="${hands}" ${prefix}:phase="${name}"/>`;
  const siblings = parent.children;
  return [...changes, insertInto(text, parent, markup, after === undefined ? undefined : siblings[siblings.indexOf(after.element) + 1])];
}

export const removePhase = (text: string, phase: Phase): Change[] => [removeElement(text, phase.element)];
