/** The face's settings as EML. */

import { apply, insertInto, read as parse, setAttribute } from '../source.js';
import { tag } from '../../speech/markup.js';
import { ALL, namesOf, type FaceControl } from './dials.js';
import { sharesAt } from './disc.js';
import type { Layers, State } from './state.js';

/** Duration of a silent face, seconds; then it restarts. */
const LENGTH_SECS = 600;
/** Start of the speech, seconds; the next constant is the duration of the picture after it. */
export const SPEAKS_SECS = 0.5;
const AFTER_SECS = 1;

const set = (parameterId: string, value: number): string => tag('body-set-control-parameter', { time: 0, parameterId, value });

/** Returns a dial's clauses: both sides in one if they are equal. */
function dial(own: FaceControl, values: State['values']): string[] {
  const [left, right] = namesOf(own).map((name) => values[name] ?? 0);
  if (left === right && left !== 0 && left !== undefined) return [set(own.name, left)];
  return namesOf(own).flatMap((name) => (values[name] ? [set(name, values[name])] : []));
}

function layers({ skin, springs, muscles, skull }: Layers): string[] {
  const attributes = {
    time: 0,
    'r:isBodyVisible': skin ? undefined : false,
    'r:areSpringsVisible': springs || undefined,
    'r:areMusclesVisible': muscles || undefined,
    'r:isSkullVisible': skull || undefined,
  };
  return Object.values(attributes).filter((value) => value !== undefined).length > 1 ? [tag('body-configure-geometry', attributes)] : [];
}

/** Returns the clauses of the speech, with its inputs and its end. */
function speech({ speech: said }: State): { head: string; clauses: string[] } {
  const end = (time: string | number): string => tag('null', { time });
  const ends = `said+${AFTER_SECS}s`;
  switch (said.kind) {
    case 'none':
      return { head: '', clauses: [end(LENGTH_SECS)] };
    case 'text':
      return { head: '', clauses: [tag('voice-text', { time: SPEAKS_SECS }, [escapeText(said.text), tag('tm', { name: 'said' })]), end(ends)] };
    case 'story': {
      const { markup, before, head } = said.line;
      const timed = markup.replace(/^<([\w:-]+)/, `<$1 time="${SPEAKS_SECS}"`).replace(/<\/([\w:-]+)>$/, '  <tm name="said"/>\n</$1>');
      return { head, clauses: [...before, timed, end(ends)] };
    }
  }
}

const escapeText = (text: string): string => text.replace(/&/g, '&amp;').replace(/</g, '&lt;');

/** Returns a head with the expressions that accompany speech set by the state. */
function accompanied(head: string, { way, manner }: State): string {
  const own = { ...(way === 'text' ? { expressions: 'text' } : {}), ...manner };
  if (Object.keys(own).length === 0) return head;
  const performer = tag('r:performer', own);
  const [top] = parse(head);
  if (top === undefined) return tag('head', {}, [performer]);
  const known = top.children.find((e) => e.name === 'r:performer');
  if (known === undefined) return apply(head, [insertInto(head, top, performer)]);
  return apply(
    head,
    Object.entries(own).flatMap(([name, value]) => setAttribute(known, name, String(value))),
  );
}

/** Writes a complete script that sets everything at its beginning. */
export function write(state: State): string {
  const { head: needed, clauses: said } = speech(state);
  const head = accompanied(needed, state);
  const blended = sharesAt(state.emotion).map(({ word, value }) => set(word.word, Number(value.toFixed(2))));
  const felt = state.word === '' ? blended : [set(state.word, 1)];
  const clauses = [...layers(state.layers), ...felt, ...ALL.flatMap((own) => dial(own, state.values)), ...said];
  const extended = [head, ...clauses].some((clause) => /<(?:[^>]*\s)?r:/.test(clause));
  const parts = [...(head === '' ? [] : [head]), tag('body', {}, clauses)];
  return `${tag('eml', { 'xmlns:r': extended ? 'urn:raconteur:eml:1' : undefined, name: 'face' }, parts)}\n`;
}
