/** The form of a question, over the stage: controls of HTML, which every browser, keyboard and screen reader knows. */

import { html, nothing, type TemplateResult } from 'lit';
import type { Answered } from './lesson.js';
import type { Question } from './types.js';

/** What was chosen in a form. */
const chosenIn = (form: HTMLFormElement): string[] => new FormData(form).getAll('option').map(String);

/** What a learner reads after an answer that was not right, while there are tries left. */
function said({ hint, tries }: Question, { tries: used, isFinal }: Answered): string {
  if (isFinal) return '';
  const left = tries - used;
  return `Not yet. ${hint === undefined ? '' : `${hint} `}${left === 1 ? 'One try is left.' : `${left} tries are left.`}`;
}

export function questionForm(question: Question, last: Answered | undefined, answer: (given: readonly string[]) => void): TemplateResult {
  const type = question.kind === 'choice' ? 'radio' : 'checkbox';
  const submit = (event: SubmitEvent): void => {
    event.preventDefault();
    answer(chosenIn(event.currentTarget as HTMLFormElement));
  };
  return html`<form class="question" part="question" @submit=${submit}>
    <fieldset>
      <legend>${question.prompt}</legend>
      ${question.options.map(
        ({ name, text }) => html`<label part="option"><input type=${type} name="option" value=${name} ?required=${type === 'radio'} /><span>${text}</span></label>`,
      )}
    </fieldset>
    <p class="said" role="status">${last === undefined ? nothing : said(question, last)}</p>
    <button part="button submit">Answer</button>
  </form>`;
}
