/** What one does to a face, as data: histories and saved sessions are lists of it. */

import type { FaceConstraint, FacePart, FaceRegion, Faces } from '../element/faces.js';
import type { FaceLook, FaceMark } from '../element/types.js';
import { isLook, isMark, MOST_MARKS } from './look.js';
import { keptWith } from './words.js';

type Three = readonly [number, number, number];

export type Act =
  | { readonly kind: 'average' }
  /** A face drawn at random. */
  | { readonly kind: 'random'; readonly seed: number }
  /** A face of the database. */
  | { readonly kind: 'example'; readonly index: number }
  | {
      readonly kind: 'add';
      readonly part: FacePart;
      readonly name: string;
      readonly amount: number;
      readonly region: FaceRegion;
      /** And of what goes with it in people. */
      readonly withAll?: boolean;
      /** Sex, weight, age and the other features of its group keep their values. */
      readonly alone?: boolean;
    }
  /** More or less of the course of a life, in shape and texture. */
  | { readonly kind: 'age'; readonly amount: number; readonly region: FaceRegion }
  | { readonly kind: 'caricature'; readonly part: FacePart; readonly level: number; readonly region: FaceRegion }
  | { readonly kind: 'import'; readonly index: number; readonly part: FacePart | 'both'; readonly region: FaceRegion }
  | { readonly kind: 'transform'; readonly scale: Three; readonly turn: Three; readonly way: Three; readonly region: FaceRegion }
  | { readonly kind: 'detail'; readonly strength: number }
  /** What is held from now on. */
  | { readonly kind: 'hold'; readonly held: readonly FaceConstraint[] }
  /** What hair the head has from now on, and what it wears. */
  | { readonly kind: 'look'; readonly look: FaceLook /** What of it is new. */; readonly what: string }
  /** What is painted on the skin from now on. */
  | { readonly kind: 'marks'; readonly marks: readonly FaceMark[]; readonly what: string };

/** Attribute of shape and texture that older people have more of. */
export const AGEING = 'ageing';

/** Does an act; then the face holds what it is to hold. Throws what the model says, when it cannot. */
export function perform(faces: Faces, act: Act, held: readonly FaceConstraint[]): void {
  const now = act.kind === 'hold' ? act.held : held;
  const reached = now.length > 0 && act.kind === 'add' && isWhole(act.region) ? reaches(faces, act) : undefined;
  alter(faces, act);
  if (now.length > 0) faces.constrain(reached === undefined ? now : [...now, reached]);
}

const isWhole = ({ segments = [], half }: FaceRegion): boolean => segments.length === 0 && half === undefined;

/** What an attribute of the whole head is to be in the end, whatever is held beside it. */
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
    case 'age':
      for (const { part, name } of faces.pack.attributes) if (name === AGEING) faces.add(part, name, act.amount, act.region);
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

/** A number with its sign, as it is printed. */
export const signed = (amount: number, digits = 2): string => `${amount < 0 ? '−' : '+'}${Math.abs(amount).toFixed(digits)}`;

/** A region in words that follow others. */
export function where({ segments = [], half }: FaceRegion): string {
  const of = half === undefined ? '' : `, ${half}`;
  return segments.length === 0 ? of : `, ${segments.join(' + ')}${of}`;
}

/** The latest of what is held, which stands last. */
function holding(names: readonly string[]): string {
  const others = names.length - 1;
  return names.length === 0 ? 'holds nothing' : `holds ${names.at(-1)}${others === 0 ? '' : ` and ${others} more`}`;
}

/** An act in a few words. */
export function label(act: Act): string {
  switch (act.kind) {
    case 'average':
      return 'Average face';
    case 'random':
      return 'A face by chance';
    case 'example':
      return `Face ${act.index + 1} of the database`;
    case 'add':
      return `${act.name} ${signed(act.amount)}${act.part === 'texture' ? ', texture' : ''}${where(act.region)}`;
    case 'age':
      return `${act.amount > 0 ? 'older' : 'younger'}${where(act.region)}`;
    case 'caricature':
      return `${act.level > 1 ? 'more' : 'less'} of itself, ${act.part}${where(act.region)}`;
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

const PARTS: readonly string[] = ['shape', 'texture'];
const isNumber = (x: unknown): x is number => typeof x === 'number' && Number.isFinite(x);
const isThree = (x: unknown): boolean => Array.isArray(x) && x.length === 3 && x.every(isNumber);
const isText = (x: unknown): boolean => typeof x === 'string' && x.length < 200;
const isCount = (x: unknown): boolean => Number.isSafeInteger(x) && (x as number) >= 0;
const isRecord = (x: unknown): x is Record<string, unknown> => typeof x === 'object' && x !== null;

function isRegion(x: unknown): boolean {
  if (!isRecord(x)) return false;
  const { segments = [], half } = x;
  return Array.isArray(segments) && segments.length < 100 && segments.every(isText) && (half === undefined || half === 'left' || half === 'right');
}

const isFlag = (x: unknown): boolean => x === undefined || typeof x === 'boolean';
const isPart = (x: unknown): boolean => PARTS.includes(x as string);

/** Whether what a file holds is an act; names and numbers of faces are the model's to refuse. */
export function isAct(x: unknown): x is Act {
  if (!isRecord(x)) return false;
  switch (x['kind']) {
    case 'average':
      return true;
    case 'random':
      return isCount(x['seed']) && (x['seed'] as number) < 2 ** 32;
    case 'example':
      return isCount(x['index']);
    case 'add':
      return isPart(x['part']) && isText(x['name']) && isNumber(x['amount']) && isRegion(x['region']) && isFlag(x['withAll']) && isFlag(x['alone']);
    case 'age':
      return isNumber(x['amount']) && isRegion(x['region']);
    case 'caricature':
      return isPart(x['part']) && isNumber(x['level']) && isRegion(x['region']);
    case 'import':
      return isCount(x['index']) && (x['part'] === 'both' || isPart(x['part'])) && isRegion(x['region']);
    case 'transform':
      return isThree(x['scale']) && isThree(x['turn']) && isThree(x['way']) && isRegion(x['region']);
    case 'detail':
      return isNumber(x['strength']);
    case 'hold':
      return (
        Array.isArray(x['held']) &&
        x['held'].length < 200 &&
        x['held'].every((h: unknown) => isRegion(h) && isRecord(h) && isPart(h['part']) && isText(h['name']) && isNumber(h['value']))
      );
    case 'look':
      return isText(x['what']) && isLook(x['look']);
    case 'marks':
      return isText(x['what']) && Array.isArray(x['marks']) && x['marks'].length <= MOST_MARKS && x['marks'].every(isMark);
    default:
      return false;
  }
}
