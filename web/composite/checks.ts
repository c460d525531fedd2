/** Validation of actions in a file, with a description of any fault. */

import type { Act } from './acts.js';
import { LIMITS } from './limits.js';
import { isLook, isMark, MAX_MARKS } from './look.js';

/** Description of a fault, for use after "step 12:"; undefined if there is none. */
type Fault = string | undefined;
type Fields = Readonly<Record<string, unknown>>;

const isRecord = (x: unknown): x is Record<string, unknown> => typeof x === 'object' && x !== null && !Array.isArray(x);

/** Returns the first fault in a list. */
const first = (...faults: readonly Fault[]): Fault => faults.find((fault) => fault !== undefined);

function number(name: string, x: unknown, least: number, most: number): Fault {
  if (typeof x !== 'number' || Number.isNaN(x)) return `${name} is not a number`;
  if (x > most) return `${name} ${x} is more than ${most}`;
  return x < least ? `${name} ${x} is less than ${least}` : undefined;
}

const amount = (name: string, x: unknown): Fault => number(name, x, -LIMITS.amount, LIMITS.amount);

function three(name: string, x: unknown, least: number, most: number): Fault {
  if (!Array.isArray(x) || x.length !== 3) return `${name} is not three numbers`;
  return first(...x.map((one: unknown) => number(name, one, least, most)));
}

function count(name: string, x: unknown, below: number): Fault {
  return Number.isSafeInteger(x) ? number(name, x, 0, below - 1) : `${name} is not a whole number`;
}

function text(name: string, x: unknown): Fault {
  if (typeof x !== 'string') return `${name} is not a text`;
  return x.length < LIMITS.letters ? undefined : `${name} has more than ${LIMITS.letters} letters`;
}

function list(name: string, x: unknown, most: number, one: (entry: unknown) => Fault): Fault {
  if (!Array.isArray(x)) return `${name} is not a list`;
  if (x.length > most) return `${name} has ${x.length} entries, more than ${most}`;
  return first(...x.map(one));
}

const oneOf = (name: string, x: unknown, words: readonly string[]): Fault => (words.includes(x as string) ? undefined : `${name} is not one of ${words.join(', ')}`);
const part = (x: unknown): Fault => oneOf('part', x, ['shape', 'texture']);
const flag = (name: string, x: unknown): Fault => (x === undefined || typeof x === 'boolean' ? undefined : `${name} is neither true nor false`);

function region(x: unknown): Fault {
  if (!isRecord(x)) return 'region is missing';
  const { segments = [], half } = x;
  return first(
    list('region', segments, LIMITS.segments, (name) => text('segment', name)),
    half === undefined ? undefined : oneOf('half', half, ['left', 'right']),
  );
}

function held(x: unknown): Fault {
  if (!isRecord(x)) return 'the held values cannot be read';
  return first(part(x['part']), text('name', x['name']), amount('value', x['value']), region(x));
}

const CHECKS: Readonly<Record<Act['kind'], (act: Fields) => Fault>> = {
  average: () => undefined,
  random: ({ seed }) => count('seed', seed, LIMITS.seed),
  example: ({ index }) => count('face', index, Number.MAX_SAFE_INTEGER),
  add: (act) =>
    first(part(act['part']), text('name', act['name']), amount('amount', act['amount']), region(act['region']), flag('withAll', act['withAll']), flag('alone', act['alone'])),
  asymmetry: (act) => first(part(act['part']), text('name', act['name']), amount('amount', act['amount']), region(act['region'])),
  age: (act) => first(amount('amount', act['amount']), region(act['region'])),
  caricature: (act) => first(part(act['part']), number('level', act['level'], ...LIMITS.level), region(act['region'])),
  import: (act) => first(count('face', act['index'], Number.MAX_SAFE_INTEGER), oneOf('part', act['part'], ['shape', 'texture', 'both']), region(act['region'])),
  transform: (act) =>
    first(
      three('scale', act['scale'], ...LIMITS.scale),
      three('turn', act['turn'], -LIMITS.turn, LIMITS.turn),
      three('way', act['way'], -LIMITS.way, LIMITS.way),
      region(act['region']),
    ),
  detail: ({ strength }) => amount('detail', strength),
  hold: (act) => list('the list of held values', act['held'], LIMITS.held, held),
  look: ({ what, look }) => first(text('name', what), isLook(look) ? undefined : 'its hair or an accessory is unknown'),
  marks: ({ what, marks }) =>
    first(
      text('name', what),
      list('marks', marks, MAX_MARKS, (mark) => (isMark(mark) ? undefined : 'a mark is unknown')),
    ),
};

/** Checks the nesting depth and the number of values of a step. */
function shape(x: unknown): Fault {
  let values = 0;
  let level: unknown[] = [x];
  for (let depth = 0; level.length > 0; depth += 1) {
    if (depth > LIMITS.depth) return `it is nested more than ${LIMITS.depth} deep`;
    values += level.length;
    if (values > LIMITS.values) return `it has more than ${LIMITS.values} values`;
    level = level.flatMap((one) => (typeof one === 'object' && one !== null ? Object.values(one) : []));
  }
  return undefined;
}

/** Returns the fault of an action in a file; the model validates names and numbers of faces. */
export function faultOf(act: unknown): Fault {
  const fault = shape(act);
  if (fault !== undefined) return fault;
  const kind = isRecord(act) ? act['kind'] : undefined;
  if (!isRecord(act) || typeof kind !== 'string' || !Object.hasOwn(CHECKS, kind)) return 'it is not an edit of a face';
  return CHECKS[kind as Act['kind']](act);
}

export const isAct = (act: unknown): act is Act => faultOf(act) === undefined;
