/** Result page of a learner after the story: points by question, and further actions. */

import { html, nothing, render, type TemplateResult } from 'lit';
import type { Answered, Score } from '../element/base/answers.js';
import { rightAnswer } from '../element/lesson/feedback.js';
import { wordsOf } from '../element/lesson/question-words.js';
import type { Question } from '../element/base/questions.js';
import { givenText } from './given.js';
import type { CourseWords } from './words.js';

/** Displayed data of an attempt. */
export interface Attempt {
  readonly questions: readonly Question[];
  readonly answered: readonly Answered[];
  readonly score: Score;
  /** Score of the best attempt. */
  readonly best: Score;
  /** Undefined where there is no rule. */
  readonly isPassed: boolean | undefined;
}

export interface ResultActions {
  /** Begins a new attempt. */
  again(): void;
  /** Replays the story with the given answers. */
  review(): void;
}

/** Returns the outcome of a question. */
function outcomeOf({ isUngraded }: Question, answered: Answered | undefined): 'unanswered' | 'taken' | 'right' | 'wrong' {
  if (answered === undefined) return 'unanswered';
  if (isUngraded === true) return 'taken';
  return answered.isRight === true ? 'right' : 'wrong';
}

function row(question: Question, answered: Answered | undefined, words: CourseWords, language: string): TemplateResult {
  const outcome = outcomeOf(question, answered);
  const given = answered === undefined ? '' : givenText(question, answered.given);
  const right = outcome === 'right' || question.isUngraded === true ? '' : rightAnswer(question, wordsOf(language));
  return html`<li class=${outcome}>
    <h3 dir="auto">${promptOf(question)}</h3>
    <p class="mark">${words[outcome]}${question.points > 0 ? html` · ${words.points(answered?.points ?? 0, question.points)}` : nothing}</p>
    ${given === '' ? nothing : html`<p dir="auto">${words.yours(given)}</p>`} ${right === '' ? nothing : html`<p dir="auto">${words.solution(right)}</p>`}
  </li>`;
}

/** Returns the prompt of a question with placeholders for gaps. */
const promptOf = ({ kind, prompt }: Question): string => (kind === 'gap' ? prompt.replaceAll(/\[[^[\]]*\]/g, '___') : prompt);

/** Draws the result into a section of the page. */
export function showResult(into: HTMLElement, { questions, answered, score, best, isPassed }: Attempt, words: CourseWords, language: string, actions: ResultActions): void {
  const verdict = isPassed === undefined ? nothing : html`<p class="verdict">${isPassed ? words.passed : words.failed}</p>`;
  render(
    html`<h2 id="result" tabindex="-1">${words.result}</h2>
      ${verdict} ${score.most > 0 ? html`<p class="score">${words.points(score.points, score.most)}</p>` : nothing}
      ${best.points > score.points ? html`<p class="score">${words.best(best.points, best.most)}</p>` : nothing}
      <ol>
        ${questions.map((question) =>
          row(
            question,
            answered.find(({ name }) => name === question.name),
            words,
            language,
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
