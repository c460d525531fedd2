/** Actions on a face, as data: histories and saved sessions are lists of them. */

import type { FaceConstraint, FacePart, FaceRegion, Faces } from '../element/face/faces.js';
import type { FaceLook, FaceMark } from '../element/base/face-types.js';
import { keptWith } from './words.js';

type Vector3 = readonly [number, number, number];

export type Act =
  | { readonly kind: 'average' }
  /** A random face. */
  | { readonly kind: 'random'; readonly seed: number }
  /** A face of the database. */
  | { readonly kind: 'example'; readonly index: number }
  | {
      readonly kind: 'add';
      readonly part: FacePart;
      readonly name: string;
      readonly amount: number;
      readonly region: FaceRegion;
      /** True to change correlated features, too. */
      readonly withAll?: boolean;
      /** True to move only a feature's own part of the face; for attributes of the whole person, such as sex or age, the others keep their values. */
      readonly alone?: boolean;
    }
  /** Asymmetry of an attribute: `amount` more on the left half, and less on the right. */
  | { readonly kind: 'asymmetry'; readonly part: FacePart; readonly name: string; readonly amount: number; readonly region: FaceRegion }
  /** Change along the course of a life, in shape and texture. */
  | { readonly kind: 'age'; readonly amount: number; readonly region: FaceRegion }
  | { readonly kind: 'caricature'; readonly part: FacePart; readonly level: number; readonly region: FaceRegion }
  | { readonly kind: 'import'; readonly index: number; readonly part: FacePart | 'both'; readonly region: FaceRegion }
  | { readonly kind: 'transform'; readonly scale: Vector3; readonly turn: Vector3; readonly way: Vector3; readonly region: FaceRegion }
  | { readonly kind: 'detail'; readonly strength: number }
  /** New constraints. */
  | { readonly kind: 'hold'; readonly held: readonly FaceConstraint[] }
  /** New hair and accessories of the head. */
  | { readonly kind: 'look'; readonly look: FaceLook /** Changed part. */; readonly what: string }
  /** New marks on the skin. */
  | { readonly kind: 'marks'; readonly marks: readonly FaceMark[]; readonly what: string };

/** Attribute of shape and texture that older people have more of. */
export const AGEING = 'ageing';

/** Years per unit of the age attribute. */
const YEARS = 40;

/** Performs an action and then applies the constraints. Throws the model's error if it is impossible. */
export function perform(faces: Faces, act: Act, held: readonly FaceConstraint[]): void {
  const now = act.kind === 'hold' ? act.held : held;
  const reached = now.length > 0 && act.kind === 'add' && isWhole(act.region) ? reaches(faces, act) : undefined;
  alter(faces, act);
  if (now.length > 0) hold(faces, reached === undefined ? now : [...now, reached]);
}

/** Returns the parts of a face that an action can change, given the constraints. */
export function changedBy(act: Act, held: readonly FaceConstraint[]): readonly FacePart[] {
  const both = ['shape', 'texture'] as const;
  const own = ((): readonly FacePart[] => {
    switch (act.kind) {
      case 'add':
      case 'asymmetry':
      case 'caricature':
        return [act.part];
      case 'transform':
        return ['shape'];
      case 'detail':
        return ['texture'];
      case 'look':
      case 'marks':
        return [];
      default:
        return both;
    }
  })();
  return both.filter((part) => own.includes(part) || held.some((h) => h.part === part));
}

/** Applies the constraints to the face; the error of an impossible one names two contradictory values. */
function hold(faces: Faces, all: readonly FaceConstraint[]): void {
  try {
    faces.constrain(all);
  } catch (error) {
    const both = contradiction(faces, all);
    if (both === undefined) throw error;
    const [one, other] = both.map((h) => `${h.name} ${signed(h.value)}${h.part === 'texture' ? ', texture' : ''}${where(h)}`);
    throw new Error(`No face has both: ${one}, and ${other}. Release one of them.`, { cause: error });
  }
}

/** Returns two contradictory values; undefined if only three or more contradict each other. */
function contradiction(faces: Faces, all: readonly FaceConstraint[]): readonly [FaceConstraint, FaceConstraint] | undefined {
  const from = faces.keep();
  const meets = (some: readonly FaceConstraint[]): boolean => {
    try {
      faces.constrain(some);
      return true;
    } catch {
      return false;
    } finally {
      faces.restore(from);
    }
  };
  const last = all.find((_, i) => !meets(all.slice(0, i + 1)));
  const other = last && all.slice(0, all.indexOf(last)).find((h) => h.part === last.part && !meets([h, last]));
  return last === undefined || other === undefined ? undefined : [other, last];
}

const isWhole = ({ segments = [], half }: FaceRegion): boolean => segments.length === 0 && half === undefined;

/** Returns the final value of an attribute of the whole head, whatever the other constraints. */
function reaches(faces: Faces, { part, name, amount }: Extract<Act, { kind: 'add' }>): FaceConstraint {
  return { part, name, value: faces.value(part, name) + amount };
}

function add(faces: Faces, { part, name, amount, region, withAll = false, alone = false }: Extract<Act, { kind: 'add' }>): void {
  const { attributes } = faces.pack;
  const attribute = alone && isWhole(region) ? attributes.find((a) => a.part === part && a.name === name) : undefined;
  if (attribute === undefined) faces.add(part, name, amount, region, withAll);
  else {
    const kept = keptWith(attribute, attributes).map((a) => a.name);
    faces.addAlone(part, name, amount, kept);
  }
}

function alter(faces: Faces, act: Act): void {
  switch (act.kind) {
    case 'average':
      faces.average();
      break;
    case 'random':
      faces.random(act.seed);
      break;
    case 'example':
      faces.example(act.index);
      break;
    case 'add':
      add(faces, act);
      break;
    case 'asymmetry':
      faces.add(act.part, act.name, act.amount, { ...act.region, half: 'left' });
      faces.add(act.part, act.name, -act.amount, { ...act.region, half: 'right' });
      break;
    case 'age':
      faces.addYears(YEARS * act.amount, act.region);
      break;
    case 'caricature':
      faces.caricature(act.part, act.level, act.region);
      break;
    case 'import':
      for (const part of act.part === 'both' ? (['shape', 'texture'] as const) : [act.part]) faces.importFrom(act.index, part, act.region);
      break;
    case 'transform':
      faces.transform(act, act.region);
      break;
    case 'detail':
      faces.addDetail(act.strength);
      break;
    case 'hold':
    case 'look':
    case 'marks':
  }
}

/** Formats a number with its sign, for display. */
export const signed = (amount: number, digits = 2): string => `${amount < 0 ? '−' : '+'}${Math.abs(amount).toFixed(digits)}`;

/** Returns a description of a region, for use within a sentence. */
export function where({ segments = [], half }: FaceRegion): string {
  const of = half === undefined ? '' : `, ${half}`;
  return segments.length === 0 ? of : `, ${segments.join(' + ')}${of}`;
}

/** Returns a description of the latest constraint, the last in the list. */
function holding(names: readonly string[]): string {
  const others = names.length - 1;
  return names.length === 0 ? 'holds nothing' : `holds ${names.at(-1)}${others === 0 ? '' : ` and ${others} more`}`;
}

/** Describes an act in a few words. */
export function label(act: Act): string {
  switch (act.kind) {
    case 'average':
      return 'Average face';
    case 'random':
      return 'A random face';
    case 'example':
      return `Face ${act.index + 1} of the database`;
    case 'add':
      return `${act.name} ${signed(act.amount)}${act.part === 'texture' ? ', texture' : ''}${where(act.region)}`;
    case 'asymmetry':
      return `${act.name} ${signed(act.amount)} left, ${signed(-act.amount)} right${act.part === 'texture' ? ', texture' : ''}${where(act.region)}`;
    case 'age':
      return `${act.amount > 0 ? 'older' : 'younger'} ${signed(act.amount)}${where(act.region)}`;
    case 'caricature':
      return `${act.level > 1 ? 'more' : 'less'} of itself ${signed(100 * (act.level - 1), 0)} %, ${act.part}${where(act.region)}`;
    case 'import':
      return `from face ${act.index + 1}, ${act.part}${where(act.region)}`;
    case 'transform':
      return `moved${where(act.region)}`;
    case 'detail':
      return `detail ${signed(act.strength, 1)}`;
    case 'hold':
      return holding(act.held.map((h) => h.name));
    case 'look':
    case 'marks':
      return act.what;
  }
}
