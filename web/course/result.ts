/** What a learner has reached, once the story has ended: points by question, and the ways on from there. */

import { html, nothing, render, type TemplateResult } from 'lit';
import type { Answered, Score } from '../element/lesson.js';
import type { Question } from '../element/types.js';
import { givenText, rightText } from './solutions.js';
import type { CourseWords } from './words.js';

/** What is shown of an attempt. */
export interface Attempt {
  readonly questions: readonly Question[];
  readonly answered: readonly Answered[];
  readonly score: Score;
  /** Undefined where there is no rule. */
  readonly isPassed: boolean | undefined;
}

export interface ResultActions {
  /** Begins a new attempt. */
  again(): void;
  /** Shows the story once more, with what was answered. */
  review(): void;
}

function row(question: Question, answered: Answered | undefined, words: CourseWords): TemplateResult {
  const isRight = answered?.isRight === true;
  const mark = answered === undefined ? words.unanswered : isRight ? words.right : words.wrong;
  const given = answered === undefined ? '' : givenText(question, answered.given);
  const right = isRight ? '' : rightText(question);
  return html`<li class=${isRight ? 'right' : 'wrong'}>
    <h3 dir="auto">${promptOf(question)}</h3>
    <p class="mark">${mark}${question.points > 0 ? html` · ${words.points(answered?.points ?? 0, question.points)}` : nothing}</p>
    ${given === '' ? nothing : html`<p dir="auto">${words.yours(given)}</p>`} ${right === '' ? nothing : html`<p dir="auto">${words.solution(right)}</p>`}
  </li>`;
}

/** A gap is a place to be filled. */
const promptOf = ({ kind, prompt }: Question): string => (kind === 'gap' ? prompt.replaceAll(/\[[^[\]]*\]/g, '___') : prompt);

/** Draws the result into a section of the page. */
export function showResult(into: HTMLElement, { questions, answered, score, isPassed }: Attempt, words: CourseWords, actions: ResultActions): void {
  const verdict = isPassed === undefined ? nothing : html`<p class="verdict">${isPassed ? words.passed : words.failed}</p>`;
  render(
    html`<h2 id="result" tabindex="-1">${words.result}</h2>
      ${verdict} ${score.most > 0 ? html`<p class="score">${words.points(score.points, score.most)}</p>` : nothing}
      <ol>
        ${questions.map((question) =>
          row(
            question,
            answered.find(({ name }) => name === question.name),
            words,
          ),
        )}
      </ol>
      <p class="ways">
        <button type="button" @click=${() => actions.again()}>${words.again}</button>
        <button type="button" class="plain" @click=${() => actions.review()}>${words.review}</button>
      </p>`,
    into,
  );
}
