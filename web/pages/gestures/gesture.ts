/** Model of the gestures in a text, with their positions in it; the form is rendered from it. */

import { attribute, within, type Element } from '../source.js';
import { parseSecs, timesOf } from './time.js';

/** Namespace of extensions to GEVH's own syntax. */
export const EXTENSIONS = 'urn:raconteur:eml:1';

export type Hand = 'right' | 'left';
export const HANDS: readonly Hand[] = ['right', 'left'];

/** Features of a hand: its handshape, the orientation of its palm, the position of its wrist. */
export type Feature = 'shape' | 'palm' | 'place';
export const FEATURES: readonly Feature[] = ['shape', 'palm', 'place'];
/** The elements of the features' tracks. */
export const TRACK_NAMES: Readonly<Record<Feature, string>> = { shape: 'hand-shapes', palm: 'palms', place: 'motion' };

/** Phases of a gesture (GEVH appendix C) and their labels. */
export const PHASES = {
  preparation: 'Preparation',
  prestroke: 'Pre-stroke hold',
  stroke: 'Stroke',
  poststroke: 'Post-stroke hold',
  retraction: 'Retraction',
  'partial-retraction': 'Partial retraction',
} as const;
export type PhaseName = keyof typeof PHASES;

/** Timing curve of a hand's movement to a key. */
export interface Course {
  readonly kind: 'linear' | 'cosine' | 'bezier' | 'hermite';
  /** Bézier: x and y of two control points; Hermite: the slopes at both ends. */
  readonly controls: readonly number[];
}

/** EML's coordinates: x to the speaker's left, y up, z to the back. */
export type Vector3 = readonly [number, number, number];

/** Value of a key; the parts present depend on the track. */
export interface Value {
  readonly shape?: { readonly id: number; readonly second?: number; readonly weight: number };
  readonly palm?: { readonly normal: Vector3; readonly angle: number };
  readonly place?: Vector3;
}

export interface Key {
  readonly element: Element;
  /** Seconds after the start of its phase. */
  readonly secs: number;
  /** Notation of its time. */
  readonly written: 'seconds' | 'percent' | 'nothing';
  readonly value: Value;
  readonly course: Course | undefined;
}

export interface Track {
  readonly element: Element;
  readonly feature: Feature;
  /** Hand of the track; undefined for every hand used. */
  readonly hand: Hand | undefined;
  /** True if positions are relative to the floor of the scene instead of the speaker's pelvis. */
  readonly world: boolean;
  readonly space: 'cartesian' | 'joint' | undefined;
  readonly course: Course | undefined;
  readonly keys: readonly Key[];
}

/** Gesture phase: one `gesture-key`. */
export interface Phase {
  readonly element: Element;
  readonly name: PhaseName | undefined;
  /** Start in seconds from that of the text; undefined if it depends on data known only to the player. */
  readonly startSecs: number | undefined;
  readonly durationSecs: number;
  readonly hands: 'right' | 'left' | 'both';
  readonly tracks: readonly Track[];
}

export interface Gesture {
  /** The `eml` element; undefined for a text without one. */
  readonly root: Element | undefined;
  readonly body: Element | undefined;
  /** Prefix of the extensions; undefined if the text does not declare it. */
  readonly prefix: string | undefined;
  readonly phases: readonly Phase[];
}

/** Returns the number of an attribute; undefined if there is none. */
function numberOf(element: Element, name: string): number | undefined {
  const written = attribute(element, name)?.trim();
  if (written === undefined || !/^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i.test(written)) return undefined;
  return Number(written);
}

const has = <T extends string>(words: readonly T[], word: string | undefined): T | undefined => words.find((w) => w === word);

/** Reads the gestures of a text. */
export function gestureOf(top: readonly Element[]): Gesture {
  const root = top.find((element) => element.name === 'eml');
  const body = root?.children.find((element) => element.name === 'body');
  const binding = root?.attributes.find((a) => a.name.startsWith('xmlns:') && a.value === EXTENSIONS);
  const prefix = binding?.name.slice('xmlns:'.length);
  const extension = (element: Element, name: string) => (prefix === undefined ? undefined : attribute(element, `${prefix}:${name}`));
  const times = body === undefined ? new Map<Element, number>() : timesOf(body);

  const courseOf = (element: Element): Course | undefined => {
    const kind = has(['linear', 'cosine', 'bezier', 'hermite'] as const, extension(element, 'interpolation'));
    if (kind === undefined) return undefined;
    const controls = (extension(element, 'controls') ?? '')
      .split(/[\s,;]+/)
      .filter((word) => word !== '')
      .map(Number);
    const wanted = kind === 'bezier' ? 4 : kind === 'hermite' ? 2 : 0;
    return controls.length === wanted && controls.every(Number.isFinite) ? { kind, controls } : undefined;
  };

  const valueAt = (feature: Feature, key: Element): Value | undefined => {
    const [x, y, z] = ['x', 'y', 'z'].map((axis) => numberOf(key, axis));
    if (feature === 'shape') {
      const id = numberOf(key, 'id');
      if (id === undefined) return undefined;
      const second = Number(extension(key, 'id2') ?? NaN);
      const weight = Number(extension(key, 'weight') ?? 0.5);
      return { shape: { id, weight: Number.isFinite(weight) ? weight : 0.5, ...(Number.isFinite(second) ? { second } : {}) } };
    }
    if (x === undefined || y === undefined || z === undefined) return undefined;
    if (feature === 'place') return { place: [x, y, z] };
    const angle = numberOf(key, 'a');
    return angle === undefined || Math.hypot(x, y, z) === 0 ? undefined : { palm: { normal: [x, y, z], angle } };
  };

  const trackOf = (element: Element, feature: Feature, durationSecs: number, goesThere: boolean): Track => {
    const keys = element.children.filter((child) => child.name === 'key');
    const secs = spread(
      keys.map((key) => attribute(key, 'time')),
      durationSecs,
      goesThere,
    );
    return {
      element,
      feature,
      hand: has(HANDS, attribute(element, 'hand')),
      world: attribute(element, 'coords') === 'world',
      space: has(['cartesian', 'joint'] as const, extension(element, 'space')),
      course: courseOf(element),
      keys: keys.flatMap((key, i): Key[] => {
        const value = valueAt(feature, key);
        const written = attribute(key, 'time')?.trim();
        return value === undefined
          ? []
          : [{ element: key, secs: secs[i] ?? 0, written: written === undefined ? 'nothing' : written.endsWith('%') ? 'percent' : 'seconds', value, course: courseOf(key) }];
      }),
    };
  };

  const phases = [...within(body?.children ?? [])].flatMap((element): Phase[] => {
    if (element.name !== 'gesture-key') return [];
    const durationSecs = parseSecs(attribute(element, 'duration') ?? '');
    if (durationSecs === undefined) return [];
    const name = has(Object.keys(PHASES) as PhaseName[], extension(element, 'phase'));
    const goesThere = name === 'preparation' || name === 'retraction' || name === 'partial-retraction';
    const tracks = element.children.flatMap((child): Track[] => {
      const feature = FEATURES.find((f) => TRACK_NAMES[f] === child.name);
      return feature === undefined ? [] : [trackOf(child, feature, durationSecs, goesThere)];
    });
    return [{ element, name, startSecs: times.get(element), durationSecs, hands: has(['right', 'left', 'both'] as const, attribute(element, 'handedness')) ?? 'both', tracks }];
  });
  return { root, body, prefix, phases };
}

/**
 * Returns the times of keys in seconds from their attributes: seconds, percent of the duration, or nothing, which spaces them evenly between their neighbours.
 * A single key without a time lies at the start, or at the end of a phase that moves to a target.
 */
function spread(written: readonly (string | undefined)[], durationSecs: number, goesThere: boolean): number[] {
  const secs = written.map((time) => {
    if (time === undefined) return undefined;
    const percent = /^\s*(\d+\.?\d*|\.\d+)\s*%\s*$/.exec(time)?.[1];
    return percent === undefined ? parseSecs(time) : (Number(percent) / 100) * durationSecs;
  });
  const last = secs.length - 1;
  if (last === 0 && goesThere) secs[0] ??= durationSecs;
  if (last >= 0) secs[0] ??= 0;
  if (last >= 0) secs[last] ??= Math.max(durationSecs, ...secs.filter((s) => s !== undefined));
  let from = 0;
  for (let to = 1; to <= last; to += 1) {
    const [start, end] = [secs[from], secs[to]];
    if (start === undefined || end === undefined) continue;
    for (let i = from + 1; i < to; i += 1) secs[i] = start + ((end - start) * (i - from)) / (to - from);
    from = to;
  }
  return secs.map((s) => s ?? 0);
}

/** Returns true if the hands differ: some track is for one of them. */
export const toldApart = (phase: Phase): boolean => phase.hands === 'both' && phase.tracks.some((track) => track.hand !== undefined);

/** Returns the track of a hand for a feature: its own, or else the common one. */
export function trackOf(phase: Phase, feature: Feature, hand: Hand): Track | undefined {
  if (phase.hands !== 'both' && phase.hands !== hand) return undefined;
  const tracks = phase.tracks.filter((track) => track.feature === feature);
  return tracks.find((track) => track.hand === hand) ?? tracks.find((track) => track.hand === undefined);
}

/** Returns true if a hand performs the mirror image of its track (GEVH D.5.4: the dominant hand is the right). */
export const mirrored = (phase: Phase, track: Track, hand: Hand): boolean => phase.hands === 'both' && track.hand === undefined && hand === 'left';

/** Returns a value mirrored to the other side of the body. */
export function mirror(value: Value): Value {
  const flip = ([x, y, z]: Vector3): Vector3 => [x === 0 ? 0 : -x, y, z];
  return {
    ...value,
    ...(value.palm && { palm: { normal: flip(value.palm.normal), angle: value.palm.angle === 0 ? 0 : -value.palm.angle } }),
    ...(value.place && { place: flip(value.place) }),
  };
}

/** Difference below which times count as equal, seconds. */
const SAME_SECS = 0.005;

/**
 * Returns the key and those of other phases with the same value at the same time: each phase begins where the previous ends (GEVH appendix C), so they move
 * together.
 */
export function joined({ phases }: Gesture, phase: Phase, feature: Feature, hand: Hand, key: Key): Key[] {
  const { startSecs } = phase;
  const others = phases.flatMap((other) => {
    if (other === phase || startSecs === undefined || other.startSecs === undefined) return [];
    const apartSecs = other.startSecs - startSecs - key.secs;
    const keys = trackOf(other, feature, hand)?.keys ?? [];
    return keys.filter((k) => Math.abs(apartSecs + k.secs) < SAME_SECS && JSON.stringify(k.value) === JSON.stringify(key.value));
  });
  return [key, ...others];
}
