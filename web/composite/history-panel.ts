/** The history as a list: thumbnails and descriptions of its steps, its branches, and the named faces. */

import { html, nothing, type TemplateResult } from 'lit';
import { label } from './acts.js';
import type { App } from './app.js';
import type { Step } from './history.js';
import type { KeptPanel } from './kept-panel.js';
import type { Thumbnails } from './thumbnails.js';

/** Maximum number of steps listed at a time. */
const LISTED = 200;

/** Returns the origin of a step, if it is not the preceding step. */
export function branch({ parent }: Step, step: number): string | undefined {
  if (parent === step - 1) return undefined;
  return parent === 0 ? 'from the beginning' : `from step ${parent}`;
}

export class HistoryPanel {
  /** First listed step, as requested from the present one. */
  #asked: { readonly first: number; readonly here: number; readonly history: App['history'] } | undefined;

  constructor(
    private readonly app: App,
    private readonly thumbnails: Thumbnails,
    private readonly kept: KeptPanel | undefined,
  ) {}

  draw(): TemplateResult {
    const { history } = this.app;
    const { steps, here } = history;
    const on = new Set(history.path());
    const first = this.#first();
    const named = steps.flatMap((step, i) => (step.name === undefined ? [] : [{ i, step }]));
    const entry = (i: number, step: Step): TemplateResult => this.#entry(i, step, on.has(i));
    const name = (event: Event): void => {
      event.preventDefault();
      const input = (event.currentTarget as HTMLFormElement).querySelector('input');
      this.app.name(input?.value.trim() ?? '');
    };
    return html`<form class="line" @submit=${name}>
        <label class="select"><span>Name this face</span><input type="text" maxlength="60" .value=${steps[here]?.name ?? ''} autocomplete="off" /></label><button type="submit" class="plain">Name</button>
      </form>
      ${this.kept?.draw() ?? nothing}
      ${named.length === 0 ? nothing : html`<h3>Named</h3><ul class="steps-list" aria-label="Named faces">${named.map(({ i, step }) => entry(i, step))}</ul>`}
      <h3>${steps.length === 1 ? 'Nothing was changed' : steps.length === 2 ? '1 step' : `${steps.length - 1} steps`}</h3>
      ${this.#leaves(first)}
      <ol class="steps-list" aria-label="Steps">${steps.slice(first, first + LISTED).map((step, i) => entry(first + i, step))}</ol>`;
  }

  /** Returns the index of the first listed step. The list is centred on the present step until the user turns the pages; going to a step lists it again. */
  #first(): number {
    const { history } = this.app;
    const most = Math.max(0, history.steps.length - LISTED);
    const asked = this.#asked;
    const follows = asked === undefined || asked.here !== history.here || asked.history !== history;
    return Math.max(0, Math.min(most, follows ? history.here - LISTED / 2 : asked.first));
  }

  #leaves(first: number): TemplateResult | typeof nothing {
    const { history } = this.app;
    const { length } = history.steps;
    if (length <= LISTED) return nothing;
    const leaf = (by: number): void => {
      this.#asked = { first: first + by, here: history.here, history };
      this.app.redraw();
    };
    return html`<div class="group" role="group" aria-label="Listed steps">
      <button type="button" class="plain" ?disabled=${first === 0} @click=${() => leaf(-LISTED)}>Earlier</button>
      <button type="button" class="plain" ?disabled=${first + LISTED >= length} @click=${() => leaf(LISTED)}>Later</button>
      <span class="range">${first} to ${Math.min(length, first + LISTED) - 1}</span>
    </div>`;
  }

  #entry(i: number, step: Step, isOn: boolean): TemplateResult {
    const picture = this.thumbnails.thumbnailOf(i);
    const from = branch(step, i);
    const current = i === this.app.history.here ? 'step' : 'false';
    return html`<li class=${isOn ? '' : 'aside'}><button type="button" class="plain step" aria-current=${current} @click=${() => this.app.goTo(i)}>
      <span class="count">${i}</span>
      <span class="small">${picture === undefined ? nothing : html`<img src=${picture} width="48" height="60" alt="" loading="lazy" />`}</span>
      <span>${step.name ?? label(step.act)}${from === undefined ? nothing : html`<small>${from}</small>`}</span></button></li>`;
  }
}
