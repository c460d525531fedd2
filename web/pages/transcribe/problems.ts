/** The list of problems, and of what was filled in. */

import { html, nothing, type TemplateResult } from 'lit';
import type { App } from './app.js';
import { clock } from './axis.js';
import { spanOf } from './tracks.js';
import type { Item, Problem } from './types.js';

/** Problems that are listed in a group; the rest is counted. */
const MAX_LISTED = 12;

/** Codes of notes on what was filled in or assumed. */
const FILLED_IN = /^(gestura::(no-|informal|gap)|elan::guess)/;

interface Group {
  readonly title: string;
  readonly problems: readonly Problem[];
}

function groups(problems: readonly Problem[]): readonly Group[] {
  const of = (title: string, belongs: (problem: Problem) => boolean): Group => ({ title, problems: problems.filter(belongs) });
  const isFilledIn = ({ code, severity }: Problem): boolean => severity === 'warning' && FILLED_IN.test(code);
  return [
    of('Errors', ({ severity }) => severity === 'error'),
    of('Against the rules of GestuRA', (problem) => problem.severity === 'warning' && !isFilledIn(problem)),
    of('Missing, so filled in or assumed', isFilledIn),
  ].filter(({ problems: some }) => some.length > 0);
}

/** Renders the problems of the annotation and of its file; `go` shows an annotation, and a field of it. */
export function problems(app: App, go: (item: Item, field: string | undefined) => void): TemplateResult {
  const all = [...app.lost, ...app.problems];
  if (all.length === 0) return html`<h2>Problems</h2><p class="fine">None. Everything in the annotation is performed as written.</p>`;
  return html`<h2>Problems</h2>
    ${groups(all).map(
      ({ title, problems: some }) => html`<h3>${title} <small>${some.length}</small></h3>
        <ul>${listed(some, (problem) => place(app, problem, go))}</ul>`,
    )}`;
}

/** Renders the problems of a file that could not be opened. */
export function refusal(name: string, found: readonly Problem[]): TemplateResult {
  return html`<p class="error">${name} could not be opened.</p>
    <ul>${listed(byPlace(found), ({ start }) => (start === undefined ? nothing : html`<strong>Line ${start.line}, column ${start.column}</strong>`))}</ul>`;
}

/** Puts problems without a place, which follow from the others, last. */
const byPlace = (found: readonly Problem[]): readonly Problem[] => [...found].sort((a, b) => Number(a.start === undefined) - Number(b.start === undefined));

function listed(some: readonly Problem[], where: (problem: Problem) => unknown): TemplateResult {
  const left = some.length - MAX_LISTED;
  return html`${some.slice(0, MAX_LISTED).map((problem) => html`<li class=${problem.severity}>${where(problem)}<span>${problem.message}${problem.hints.map((hint) => html` <small>${hint}</small>`)}</span></li>`)}
    ${left > 0 ? html`<li>… and ${left} more.</li>` : nothing}`;
}

function place(app: App, { item, field, start }: Problem, go: (item: Item, field: string | undefined) => void): unknown {
  const span = spanOf(app.tracks, item);
  if (item === undefined || span === undefined) return start === undefined ? nothing : html`<strong>Line ${start.line}</strong>`;
  return html`<button type="button" class="plain" @click=${() => go(item, field)}>${span.label} at ${clock(span.start)} s</button>`;
}
