/** What is filled in to answer a question: controls of HTML, which every browser, keyboard and screen reader knows. */

import { html, nothing, type TemplateResult } from 'lit';
import { repeat } from 'lit/directives/repeat.js';
import { gapsOf, MOST_CHARACTERS } from './judge.js';
import type { QuestionWords } from './question-words.js';
import type { Question, QuestionOption } from './types.js';

/** What fields need besides their question. */
export interface Fields {
  readonly question: Question;
  readonly words: QuestionWords;
  /** Of `order` and `match`: the names of options as they are shown. */
  readonly shown: readonly string[];
  /** Moves an option of `order` by a place. */
  move(name: string, by: -1 | 1): void;
  /** The learner turns to something that may be pointed at. */
  look(option: QuestionOption | undefined): void;
}

/** Names in an order by chance, the same at every time, that is not the one that is right. */
export function mixed({ name, options }: Question): readonly string[] {
  const names = options.map((option) => option.name);
  const order = [...names].sort((a, b) => hash(name + a) - hash(name + b));
  if (names.length > 1 && order.every((entry, i) => entry === names[i])) order.push(order.shift() ?? '');
  return order;
}

function hash(text: string): number {
  let value = 0x811c9dc5;
  for (const sign of text) value = Math.imul(value ^ (sign.codePointAt(0) ?? 0), 0x01000193) >>> 0;
  return value;
}

/** What was filled into a form, as `Answered.given` has it. */
export function givenIn(form: HTMLFormElement, { kind }: Question, shown: readonly string[]): readonly string[] {
  if (kind === 'order') return shown;
  return new FormData(form).getAll('option').map(String);
}

/** The fields of a question. */
export function fieldsOf(fields: Fields): TemplateResult {
  switch (fields.question.kind) {
    case 'choice':
    case 'several':
      return choices(fields);
    case 'point':
      return points(fields);
    case 'order':
      return order(fields);
    case 'match':
      return match(fields);
    case 'gap':
      return gaps(fields);
    case 'number':
      return html`<input class="written" name="option" type="text" inputmode="decimal" autocomplete="off" maxlength="40" required aria-label=${fields.words.yourAnswer} />`;
    case 'text':
      return html`<textarea class="written" name="option" rows="3" maxlength=${MOST_CHARACTERS} required aria-label=${fields.words.yourAnswer}></textarea>`;
  }
}

function choices({ question: { kind, options } }: Fields): TemplateResult {
  const type = kind === 'choice' ? 'radio' : 'checkbox';
  return html`${options.map(
    ({ name, text }) => html`<label part="option"><input type=${type} name="option" value=${name} ?required=${type === 'radio'} /><span dir="auto">${text}</span></label>`,
  )}`;
}

function points({ question: { options }, words, look }: Fields): TemplateResult {
  return html`<p class="said">${words.pointing}</p>
    ${options.map(
      (option, i) => html`<label part="option" @pointerenter=${() => look(option)} @pointerleave=${() => look(undefined)}>
        <input type="radio" name="option" value=${option.name} required @focus=${() => look(option)} @blur=${() => look(undefined)} />
        <span class="number" aria-hidden="true">${i + 1}</span><span dir="auto">${option.text}</span>
      </label>`,
    )}`;
}

function order({ question: { options }, words, shown, move }: Fields): TemplateResult {
  const textOf = (name: string) => options.find((option) => option.name === name)?.text ?? '';
  const ends = (name: string, by: -1 | 1) => shown.at(by < 0 ? 0 : -1) === name;
  // One that can do nothing keeps the focus.
  const button = (name: string, by: -1 | 1, label: string, sign: string) => html`<button
    type="button"
    class="move"
    aria-label=${label}
    aria-disabled=${ends(name, by)}
    data-name=${name}
    data-by=${by}
    @click=${() => move(name, by)}
  >
    ${sign}
  </button>`;
  return html`<ol>
    ${repeat(
      shown,
      (name) => name,
      (name) => html`<li part="option">
        <span dir="auto">${textOf(name)}</span>${button(name, -1, words.up(textOf(name)), '↑')}${button(name, 1, words.down(textOf(name)), '↓')}
      </li>`,
    )}
  </ol>`;
}

function match({ question: { options }, words, shown }: Fields): TemplateResult {
  const partners = shown.flatMap((name) => options.find((option) => option.name === name) ?? []);
  return html`${options.map(
    ({ text }) => html`<label part="option" class="pair"
      ><span dir="auto">${text}</span
      ><select name="option" required>
        <option value="">${words.choose}</option>
        ${partners.map(({ name, partner }) => html`<option value=${name}>${partner}</option>`)}
      </select></label
    >`,
  )}`;
}

/** The prompt with its gaps. Answers go by the order of options, whatever that of the gaps is. */
function gaps({ question, words }: Fields): TemplateResult {
  const parts = gapsOf(question);
  const count = parts.filter((part) => typeof part !== 'string').length;
  let at = 0;
  const filled = parts.map((part) => {
    if (typeof part === 'string') return part;
    at += 1;
    return html`<input class="gap" data-gap=${part.name} type="text" autocomplete="off" maxlength="200" required aria-label=${words.gap(at, count)} />`;
  });
  return html`<p class="said">${words.fill}</p>
    <p class="gaps" dir="auto">${filled.length > 0 ? filled : nothing}</p>`;
}

/** What was written into gaps, by the order of options. */
export function gapsIn(form: HTMLFormElement, { options }: Question): readonly string[] {
  const inputs = [...form.querySelectorAll<HTMLInputElement>('[data-gap]')];
  return options.map(({ name }) => inputs.find(({ dataset }) => dataset['gap'] === name)?.value ?? '');
}
