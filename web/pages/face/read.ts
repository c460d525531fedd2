/** Conversion from EML to the state of the face controls. */

import { attribute, read as parse, removeElement, setAttribute, apply, within, type Element } from '../source.js';
import { ALL, namesOf } from './dials.js';
import { at, WORDS, type WeightShare } from './disc.js';
import { ALL_AMOUNTS } from './manner.js';
import type { Line, State } from './state.js';

/** Reads the emotion, control parameters and manner set at the beginning of a script; parameters without a control on the page are ignored. */
export function read(eml: string): Pick<State, 'emotion' | 'word' | 'values' | 'way' | 'manner'> {
  const shares: WeightShare[] = [];
  let named = '';
  const values: Record<string, number> = {};
  let way: State['way'] = 'sound';
  const manner: Record<string, number> = {};
  for (const element of within(parse(eml))) {
    if (element.name === 'r:performer') {
      way = attribute(element, 'expressions') === 'text' ? 'text' : 'sound';
      for (const { name, least, most, usual } of ALL_AMOUNTS) {
        const written = attribute(element, name);
        const value = written === undefined ? usual : Math.min(most, Math.max(least, Number(written)));
        if (Number.isFinite(value) && value !== usual) manner[name] = value;
      }
    }
    if (element.name !== 'body-set-control-parameter') continue;
    const name = attribute(element, 'parameterId')?.toLowerCase() ?? '';
    const value = Number(attribute(element, 'value'));
    if (!Number.isFinite(value)) continue;
    const word = WORDS.find((w) => [w.word, ...w.also].includes(name));
    if (word !== undefined) {
      shares.push({ word, value: Math.min(1, Math.max(0, value)) });
      named = shares.length === 1 && value >= 1 ? name : '';
    }
    for (const dial of ALL) {
      const names = namesOf(dial);
      const meant = dial.name.toLowerCase() === name ? names : names.filter((n) => n.toLowerCase() === name);
      for (const own of meant) values[own] = Math.min(1, Math.max(dial.signed ? -1 : 0, value));
    }
  }
  return { emotion: at(shares), word: named, values, way, manner };
}

/** Maximum length of a sentence in a menu. */
const LABEL = 72;

/** Returns the sentences of a story, each with the context of its voice, without marks and times, so that it does not depend on other parts of the story. */
export function lines(eml: string): readonly Line[] {
  const all = [...within(parse(eml))];
  const head = all.find((e) => e.name === 'head');
  const voices: Element[] = [];
  let feeling: Element | undefined;
  const found: Line[] = [];
  const source = (e: Element): string => unindent(eml.slice(e.from, e.to));
  for (const element of all) {
    if (element.name === 'voice-change') voices.push(element);
    if (element.name === 'r:emotion') feeling = element;
    if (element.name !== 'voice-text') continue;
    const own = source(element);
    const [top] = parse(own);
    if (top === undefined) continue;
    const marks = [...within(top.children)].filter((e) => e.name === 'tm').map((e) => removeElement(own, e));
    const markup = apply(own, [...marks, ...setAttribute(top, 'time', undefined), ...setAttribute(top, 'timeId', undefined)]);
    const words = markup
      .replace(/<[^>]*>/g, ' ')
      .replace(/\s+/g, ' ')
      .replace(/ ([.,;:!?])/g, '$1')
      .trim();
    const label = words.length > LABEL ? `${words.slice(0, LABEL).replace(/\s+\S*$/, '')} …` : words;
    const before = [...voices.slice(-1), ...(feeling === undefined ? [] : [feeling])].map((e) => atStart(source(e)));
    if (label !== '') found.push({ label, markup, before, head: head === undefined ? '' : source(head) });
  }
  return found;
}

/** Converts a clause to one at the very beginning, where marks of the story are undefined. */
function atStart(markup: string): string {
  const [top] = parse(markup);
  return top === undefined ? '' : apply(markup, setAttribute(top, 'time', '0'));
}

/** Lines with as much less white space before them as the last one has. */
function unindent(markup: string): string {
  const indent = /\n([ \t]*)[^\n]*$/.exec(markup)?.[1] ?? '';
  return markup.replaceAll(`\n${indent}`, '\n');
}
