/** Form of a question, over or next to the stage. */

import { html, nothing, type TemplateResult } from 'lit';
import { languageOf, type PlayerContext } from '../story/context.js';
import { gapsOf } from './judge.js';
import { feedbackOf } from './feedback.js';
import type { TakenBranch } from './lesson.js';
import { arranged, type Box } from './markers.js';
import { Note } from './note.js';
import type { Limit } from './limit.js';
import { fieldsOf, gapsIn, givenIn, optionsIn, readOf, shownOf } from './question-fields.js';
import { addressOf } from './question-picture.js';
import { wordsOf } from './question-words.js';
import type { Question, QuestionOption, QuestionPicture } from '../base/questions.js';
import type { Story } from '../base/types.js';

/** Languages that are written from the right. */
const FROM_RIGHT = new Set(['ar', 'ckb', 'dv', 'fa', 'he', 'ps', 'sd', 'ug', 'ur', 'yi']);

export class QuestionForm {
  readonly #limit: Limit;
  /** Submits an answer; false if it is invalid. */
  readonly #answer: (given: readonly string[]) => boolean;
  readonly #contextOf: () => PlayerContext;
  #question: Question | undefined;
  #language = 'en';
  #shown: readonly string[] = [];
  #looked: QuestionOption | undefined;
  /** Message shown under the fields. */
  #said = '';
  /** Feedback on the previous question. */
  readonly #note: Note;

  constructor(limit: Limit, answer: (given: readonly string[]) => boolean, contextOf: () => PlayerContext) {
    this.#note = new Note({
      plays: () => !contextOf().player.paused && !document.hidden,
      gone: () => contextOf().player.requestUpdate(),
      left: () => contextOf().player.focus({ preventScroll: true }),
    });
    this.#limit = limit;
    this.#answer = answer;
    this.#contextOf = contextOf;
  }

  get words(): ReturnType<typeof wordsOf> {
    return wordsOf(this.#language);
  }

  /** Prompt of the current question, for announcement. */
  get prompt(): string {
    const question = this.#question;
    if (question?.kind !== 'gap') return question?.prompt ?? '';
    return gapsOf(question)
      .map((part) => (typeof part === 'string' ? part : '…'))
      .join('');
  }

  /** Bone that the learner focuses; empty if there is none. */
  get lookedAt(): string {
    return this.#looked?.at ?? '';
  }

  /** Opens another question, or closes the form. */
  open(question: Question | undefined, story: Story | undefined, seed: number): void {
    const { player, onScreen } = this.#contextOf();
    const had = player.shadowRoot?.activeElement?.closest('.question') != null;
    this.#question = question;
    this.#language = story === undefined ? 'en' : languageOf(player, story);
    this.#shown = question === undefined ? [] : shownOf(question, seed);
    this.#looked = undefined;
    this.#said = '';
    const isThere = had || document.activeElement === player;
    player.requestUpdate();
    void player.updateComplete.then(() => {
      if (question !== undefined && onScreen) this.#find('.question')?.scrollIntoView({ block: 'nearest' });
      void this.place();
      // If the player had the focus, the form receives it.
      if (!isThere) return;
      if (question === undefined) player.focus();
      else this.focus();
    });
  }

  /** Focuses the first field. */
  focus(): void {
    this.#find<HTMLElement>('.question :is(input, select, textarea, button)')?.focus();
  }

  /** Feedback on an answer; empty if there is none. */
  get feedback(): string {
    return this.#note.text;
  }

  /** Clears the feedback of an unloaded story. */
  forget(): void {
    this.#note.show('');
  }

  /** Handles an answer: shows its feedback, between tries and finally. */
  answered(taken: TakenBranch): void {
    const { question, answered } = taken;
    const { notYet, tries } = this.words;
    this.#note.show(feedbackOf(taken, this.words));
    if (answered.isFinal) return;
    this.#said = [notYet, question.hint, tries(question.tries - answered.tries)].filter(Boolean).join(' ');
  }

  /** Renders the form of the current question; otherwise the feedback on the previous one. */
  render(question: Question | undefined): TemplateResult | typeof nothing {
    const { words, prompt } = this;
    const left = this.#limit.leftSecs;
    const isFromRight = FROM_RIGHT.has(this.#language.split('-')[0] ?? '');
    const image = (picture: QuestionPicture | undefined) => this.#image(picture);
    const direction = isFromRight ? 'rtl' : 'ltr';
    if (question === undefined) return this.feedback === '' ? nothing : this.#note.render(this.#language, direction, words);
    return html`${question.kind === 'point' ? this.#markers(question) : nothing}
      <form class=${question.kind === 'point' ? 'question pointing' : 'question'} part="question" novalidate lang=${this.#language} dir=${direction} @submit=${(event: SubmitEvent) => this.#submit(event, question)}>
        ${this.feedback === '' ? nothing : html`<p class="before" part="feedback" dir="auto">${this.feedback}</p>`}
        <fieldset>
          <legend dir="auto">${prompt}</legend>
          ${image(question.picture)} ${fieldsOf({ question, words, image, shown: this.#shown, move: (name, by) => this.#move(name, by), look: (option) => this.#look(option) })}
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
    // Browsers would show messages in their own language.
    const isFilled = form.checkValidity();
    if (isFilled && this.#answer(question.kind === 'gap' ? gapsIn(form, question) : givenIn(form, question, this.#shown))) return;
    this.#said = this.words.first;
    this.#contextOf().player.requestUpdate();
    form.querySelector<HTMLElement>(isFilled ? ':is(input, select, textarea)' : ':is(input, select, textarea):invalid')?.focus();
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
    const text = readOf(this.#question?.options.find((option) => option.name === name));
    say(this.words.place(text, to + 1, order.length));
    player.requestUpdate();
    void player.updateComplete.then(() => this.#find<HTMLElement>(`.move[data-name="${CSS.escape(name)}"][data-by="${by}"]`)?.focus());
  }

  #look(option: QuestionOption | undefined): void {
    this.#looked = option;
    this.#contextOf().advance();
  }

  #image(picture: QuestionPicture | undefined): TemplateResult | typeof nothing {
    if (picture === undefined) return nothing;
    const story = new URL(this.#contextOf().player.src, document.baseURI);
    return html`<img part="picture" src=${addressOf(picture.file, story)} alt=${picture.alt} />`;
  }

  // --- drag targets ---

  /** Renders markers on the stage for pointing; the fields are an alternative. */
  #markers(question: Question): TemplateResult {
    const choose = ({ name }: QuestionOption): void => {
      const input = this.#find<HTMLInputElement>(`.question input[value="${CSS.escape(name)}"]`);
      input?.click();
    };
    return html`<div class="markers" aria-hidden="true">
      ${optionsIn(question, this.#shown).map(
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

  /** Moves the markers to the objects in the image. */
  async place(): Promise<void> {
    if (this.#question?.kind !== 'point') return;
    const { player } = this.#contextOf();
    const { readPose } = await import('../engine/pose.js');
    const pose = readPose(player);
    const { clientWidth: right, clientHeight: bottom } = player;
    const form = this.#find<HTMLElement>('.question');
    const markers = [...(player.shadowRoot?.querySelectorAll<HTMLElement>('.marker') ?? [])];
    const spots = markers.map(({ dataset: { at = '' } }) => {
      const joint = pose?.joints.find(({ name }) => name === `bone_${at}` || name === at);
      return joint && pose?.camera.project(joint.position, right, bottom);
    });
    const places = arranged(spots, { left: 0, top: 0, right, bottom }, form === null ? undefined : boxOf(form));
    markers.forEach((marker, i) => {
      const place = places[i];
      marker.hidden = place === undefined;
      if (place === undefined) return;
      marker.style.left = `${place.x}px`;
      marker.style.top = `${place.y}px`;
    });
  }

  #find<E extends Element>(selector: string): E | null {
    return this.#contextOf().player.shadowRoot?.querySelector<E>(selector) ?? null;
  }
}

const boxOf = ({ offsetLeft: left, offsetTop: top, offsetWidth, offsetHeight }: HTMLElement): Box => ({ left, top, right: left + offsetWidth, bottom: top + offsetHeight });
