/** Input fields of a question: HTML controls, supported by every browser, keyboard and screen reader. */

import { html, nothing, type TemplateResult } from 'lit';
import { repeat } from 'lit/directives/repeat.js';
import { shuffled } from './chance.js';
import { gapsOf, MAX_CHARACTERS } from './judge.js';
import type { QuestionWords } from './question-words.js';
import type { Question, QuestionOption, QuestionPicture } from '../base/questions.js';

/** Context of the fields in addition to their question. */
export interface Fields {
  readonly question: Question;
  readonly words: QuestionWords;
  /** Names of options in display order; for `match` those of their partners. */
  readonly shown: readonly string[];
  /** Moves an option of `order` by one position. */
  move(name: string, by: -1 | 1): void;
  /** Renders a picture, if there is one. */
  image(picture: QuestionPicture | undefined): TemplateResult | typeof nothing;
  /** Called when the learner focuses an item that can be pointed at. */
  look(option: QuestionOption | undefined): void;
}

/**
 * Returns the names of options in display order. Options to be matched or ordered are always shuffled, and never shown in the correct order; other options
 * keep the story's order unless shuffled. Shuffled orders differ between learners.
 */
export function shownOf({ name, kind, options, isShuffled }: Question, seed: number): readonly string[] {
  const names = options.map((option) => option.name);
  const isMixed = kind === 'order' || kind === 'match';
  if (!isMixed && isShuffled !== true) return names;
  const order = [...shuffled(names, name, isShuffled === true ? seed : 0)];
  if (isMixed && names.length > 1 && order.every((entry, i) => entry === names[i])) order.push(order.shift() ?? '');
  return order;
}

/** Returns options in display order. */
export function optionsIn({ options }: Question, shown: readonly string[]): readonly QuestionOption[] {
  return shown.flatMap((name) => options.find((option) => option.name === name) ?? []);
}

/** Returns the text alternative of an option: its text, otherwise the description of its picture. */
export const readOf = (option: QuestionOption | undefined): string => option?.text || option?.picture?.alt || '';

/** Returns the values of a form, in the format of `Answered.given`. */
export function givenIn(form: HTMLFormElement, { kind }: Question, shown: readonly string[]): readonly string[] {
  if (kind === 'order') return shown;
  return new FormData(form).getAll('option').map(String);
}

/** Renders the fields of a question. */
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
      return html`<textarea class="written" name="option" rows="3" maxlength=${MAX_CHARACTERS} required aria-label=${fields.words.yourAnswer}></textarea>`;
  }
}

function choices({ question, shown, image }: Fields): TemplateResult {
  const type = question.kind === 'choice' ? 'radio' : 'checkbox';
  return html`${optionsIn(question, shown).map(
    ({ name, text, picture }) =>
      html`<label part="option"><input type=${type} name="option" value=${name} ?required=${type === 'radio'} />${image(picture)}<span dir="auto">${text}</span></label>`,
  )}`;
}

function points({ question, shown, words, look, image }: Fields): TemplateResult {
  return html`<p class="said">${words.pointing}</p>
    ${optionsIn(question, shown).map(
      (option, i) => html`<label part="option" @pointerenter=${() => look(option)} @pointerleave=${() => look(undefined)}>
        <input type="radio" name="option" value=${option.name} required @focus=${() => look(option)} @blur=${() => look(undefined)} />
        <span class="number" aria-hidden="true">${i + 1}</span>${image(option.picture)}<span dir="auto">${option.text}</span>
      </label>`,
    )}`;
}

function order({ question, words, shown, move, image }: Fields): TemplateResult {
  const optionOf = (name: string) => question.options.find((option) => option.name === name);
  const textOf = (name: string) => readOf(optionOf(name));
  const ends = (name: string, by: -1 | 1) => shown.at(by < 0 ? 0 : -1) === name;
  // A button without effect keeps the focus.
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
        ${image(optionOf(name)?.picture)}<span dir="auto">${optionOf(name)?.text}</span>${button(name, -1, words.up(textOf(name)), '↑')}${button(name, 1, words.down(textOf(name)), '↓')}
      </li>`,
    )}
  </ol>`;
}

function match({ question, words, shown, image }: Fields): TemplateResult {
  const partners = optionsIn(question, shown);
  return html`${question.options.map(
    ({ text, picture }) => html`<label part="option" class="pair"
      >${image(picture)}<span dir="auto">${text}</span
      ><select name="option" required>
        <option value="">${words.choose}</option>
        ${partners.map(({ name, partner }) => html`<option value=${name}>${partner}</option>`)}
      </select></label
    >`,
  )}`;
}

/** Renders the prompt with its gaps. Answers follow the order of options, regardless of that of the gaps. */
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

/** Returns the contents of gaps, in the order of options. */
export function gapsIn(form: HTMLFormElement, { options }: Question): readonly string[] {
  const inputs = [...form.querySelectorAll<HTMLInputElement>('[data-gap]')];
  return options.map(({ name }) => inputs.find(({ dataset }) => dataset['gap'] === name)?.value ?? '');
}
