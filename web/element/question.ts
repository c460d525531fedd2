/** The form of a question, over or beside the stage. */

import { html, nothing, type TemplateResult } from 'lit';
import { languageOf, type PlayerContext } from './context.js';
import { gapsOf } from './judge.js';
import type { Spot } from './pose.js';
import { feedbackOf } from './feedback.js';
import type { Answered, Taken } from './lesson.js';
import { Note } from './note.js';
import type { Limit } from './limit.js';
import { fieldsOf, gapsIn, givenIn, mixed } from './question-fields.js';
import { wordsOf } from './question-words.js';
import type { Question, QuestionOption, Story } from './types.js';

/** A marker keeps so far from the edge of the picture, and from the bar of controls, pixels. */
const EDGE = 20;
const BAR = 84;
/** Languages that are written from the right. */
const FROM_RIGHT = new Set(['ar', 'ckb', 'dv', 'fa', 'he', 'ps', 'sd', 'ug', 'ur', 'yi']);

/** Where what lies at a spot is marked: within the picture, above the bar, and not under the form. */
function beside(spot: Spot, picture: { readonly clientWidth: number; readonly clientHeight: number }, form: HTMLElement | null): Spot {
  const x = Math.min(picture.clientWidth - EDGE, Math.max(EDGE, spot.x));
  const y = Math.min(picture.clientHeight - BAR - EDGE, Math.max(EDGE, spot.y));
  if (form === null) return { x, y };
  const [left, top] = [form.offsetLeft - EDGE, form.offsetTop - EDGE];
  const isUnder = x > left && x < form.offsetLeft + form.offsetWidth + EDGE && y > top && y < form.offsetTop + form.offsetHeight + EDGE;
  if (!isUnder) return { x, y };
  // To its nearer side, where there is room.
  return left >= EDGE && x - left < y - top ? { x: left, y } : { x, y: Math.max(EDGE, top) };
}

export class QuestionForm {
  readonly #limit: Limit;
  readonly #answer: (given: readonly string[]) => void;
  readonly #contextOf: () => PlayerContext;
  #question: Question | undefined;
  #language = 'en';
  #shown: readonly string[] = [];
  #looked: QuestionOption | undefined;
  #last: Answered | undefined;
  /** What the learner reads beneath the fields. */
  #said = '';
  /** What is read of the question before. */
  readonly #note: Note;

  constructor(limit: Limit, answer: (given: readonly string[]) => void, contextOf: () => PlayerContext) {
    this.#note = new Note({
      plays: () => !contextOf().player.paused && !document.hidden,
      gone: () => contextOf().player.requestUpdate(),
    });
    this.#limit = limit;
    this.#answer = answer;
    this.#contextOf = contextOf;
  }

  get words(): ReturnType<typeof wordsOf> {
    return wordsOf(this.#language);
  }

  /** What is asked, to be said. */
  get prompt(): string {
    const question = this.#question;
    if (question?.kind !== 'gap') return question?.prompt ?? '';
    return gapsOf(question)
      .map((part) => (typeof part === 'string' ? part : '…'))
      .join('');
  }

  /** The bone that the learner looks at; empty where there is none. */
  get lookedAt(): string {
    return this.#looked?.at ?? '';
  }

  /** Another question is asked, or none any more. */
  open(question: Question | undefined, story: Story | undefined): void {
    const { player, onScreen } = this.#contextOf();
    const had = player.shadowRoot?.activeElement?.closest('.question') != null;
    this.#question = question;
    this.#language = story === undefined ? 'en' : languageOf(player, story);
    this.#shown = question === undefined ? [] : mixed(question);
    this.#looked = this.#last = undefined;
    this.#said = '';
    const isThere = had || document.activeElement === player;
    player.requestUpdate();
    void player.updateComplete.then(() => {
      if (question !== undefined && onScreen) this.#find('.question')?.scrollIntoView({ block: 'nearest' });
      void this.place();
      // Whoever was in the player is where something is to be done.
      if (!isThere) return;
      if (question === undefined) player.focus();
      else this.focus();
    });
  }

  /** Goes to the first field. */
  focus(): void {
    this.#find<HTMLElement>('.question :is(input, select, textarea, button)')?.focus();
  }

  /** What is read of an answer; empty where that is nothing. */
  get feedback(): string {
    return this.#note.text;
  }

  /** Nothing is to be read of a story that goes. */
  forget(): void {
    this.#note.show('');
  }

  /** Somebody has answered: what they read, while there are tries left and for good. */
  answered(taken: Taken): void {
    const { question, answered } = taken;
    this.#last = answered;
    const { notYet, tries } = this.words;
    this.#note.show(feedbackOf(taken, this.words));
    if (answered.isFinal) return;
    this.#said = [notYet, question.hint, tries(question.tries - answered.tries)].filter(Boolean).join(' ');
  }

  /** The form of what is asked; else what is to be read of what was. */
  render(question: Question | undefined): TemplateResult | typeof nothing {
    const { words, prompt } = this;
    const left = this.#limit.leftSecs;
    const isFromRight = FROM_RIGHT.has(this.#language.split('-')[0] ?? '');
    const direction = isFromRight ? 'rtl' : 'ltr';
    if (question === undefined) return this.feedback === '' ? nothing : this.#note.render(this.#language, direction, words.close);
    return html`${question.kind === 'point' ? this.#markers(question) : nothing}
      <form class="question" part="question" lang=${this.#language} dir=${direction} @submit=${(event: SubmitEvent) => this.#submit(event, question)}>
        ${this.feedback === '' ? nothing : html`<p class="before" part="feedback" dir="auto">${this.feedback}</p>`}
        <fieldset>
          <legend dir="auto">${prompt}</legend>
          ${fieldsOf({ question, words, shown: this.#shown, move: (name, by) => this.#move(name, by), look: (option) => this.#look(option) })}
        </fieldset>
        <p class="said" role="status">${this.#said}</p>
        ${left === undefined ? nothing : html`<p class="left" role="timer">${words.left(left)}</p>`}
        <div class="answers">
          <button part="button submit">${words.answer}</button>
          ${this.#limit.mayHaveMore ? html`<button type="button" class="plain" part="button more" @click=${() => this.#limit.more()}>${words.more}</button>` : nothing}
        </div>
      </form>`;
  }

  #submit(event: SubmitEvent, question: Question): void {
    event.preventDefault();
    const form = event.currentTarget as HTMLFormElement;
    this.#last = undefined;
    this.#answer(question.kind === 'gap' ? gapsIn(form, question) : givenIn(form, question, this.#shown));
    if (this.#last !== undefined) return;
    this.#said = this.words.first;
    this.#contextOf().player.requestUpdate();
  }

  /** Moves an option of an order, and stays on the button. */
  #move(name: string, by: -1 | 1): void {
    const from = this.#shown.indexOf(name);
    const to = from + by;
    if (to < 0 || to >= this.#shown.length) return;
    const order = this.#shown.filter((entry) => entry !== name);
    order.splice(to, 0, name);
    this.#shown = order;
    const { player, say } = this.#contextOf();
    const text = this.#question?.options.find((option) => option.name === name)?.text ?? '';
    say(this.words.place(text, to + 1, order.length));
    player.requestUpdate();
    void player.updateComplete.then(() => this.#find<HTMLElement>(`.move[data-name="${CSS.escape(name)}"][data-by="${by}"]`)?.focus());
  }

  #look(option: QuestionOption | undefined): void {
    this.#looked = option;
    this.#contextOf().advance();
  }

  // --- what is pointed at ---

  /** Marks on the stage, for those who point; who does not has the fields. */
  #markers({ options }: Question): TemplateResult {
    const choose = ({ name }: QuestionOption): void => {
      const input = this.#find<HTMLInputElement>(`.question input[value="${CSS.escape(name)}"]`);
      input?.click();
    };
    return html`<div class="markers" aria-hidden="true">
      ${options.map(
        (option, i) => html`<button
          type="button"
          class="marker"
          part="marker"
          tabindex="-1"
          data-at=${option.at ?? ''}
          @pointerenter=${() => this.#look(option)}
          @pointerleave=${() => this.#look(undefined)}
          @click=${() => choose(option)}
        >
          ${i + 1}
        </button>`,
      )}
    </div>`;
  }

  /** Puts the marks where the picture has what they mean. */
  async place(): Promise<void> {
    if (this.#question?.kind !== 'point') return;
    const { player } = this.#contextOf();
    const { readPose } = await import('./pose.js');
    const pose = readPose(player);
    const { clientWidth, clientHeight } = player;
    const form = this.#find<HTMLElement>('.question');
    for (const marker of player.shadowRoot?.querySelectorAll<HTMLElement>('.marker') ?? []) {
      const joint = pose?.joints.find(({ name }) => name === `bone_${marker.dataset['at'] ?? ''}` || name === marker.dataset['at']);
      const spot = joint && pose?.camera.project(joint.position, clientWidth, clientHeight);
      marker.hidden = spot === undefined;
      if (spot === undefined) continue;
      const { x, y } = beside(spot, { clientWidth, clientHeight }, form);
      marker.style.left = `${x}px`;
      marker.style.top = `${y}px`;
    }
  }

  #find<E extends Element>(selector: string): E | null {
    return this.#contextOf().player.shadowRoot?.querySelector<E>(selector) ?? null;
  }
}
