/** Panel of scars, moles, birthmarks and tattoos: the next one to place, and a list of existing ones. */

import { html, nothing, type TemplateResult } from 'lit';
import type { FaceMark, FaceSpot, TattooShape } from '../element/base/face-types.js';
import { numberField } from '../pages/fields.js';
import type { App } from './app.js';
import { MAX_MARK_LENGTH, MARKS, MAX_LETTERS, MAX_MARKS, SHAPES } from './look.js';

const DEGREE = Math.PI / 180;

/** Places the selected mark at a spot of the skin; returns false if that is impossible. */
export function place(app: App, spot: FaceSpot): boolean {
  const { placing } = app;
  if (placing === undefined) return false;
  app.placing = undefined;
  if (typeof placing === 'number') {
    const moved = app.marks.map((mark, i) => (i === placing ? { ...mark, ...spot } : mark));
    return app.do({ kind: 'marks', marks: moved, what: 'mark moved' });
  }
  const kind = placing;
  const { size, turn, strength } = MARKS[kind];
  const mark: FaceMark = { ...spot, kind, size, turn, strength };
  return app.do({ kind: 'marks', marks: [...app.marks, mark], what: `${MARKS[kind].name.toLowerCase()} placed` });
}

export function marks(app: App): TemplateResult {
  const { marks: all, placing } = app;
  const choose = (kind: FaceMark['kind']): void => {
    app.placing = placing === kind ? undefined : kind;
    app.redraw();
  };
  const full = all.length >= MAX_MARKS;
  return html`<div class="group" role="group" aria-label="Place">
      ${(Object.keys(MARKS) as FaceMark['kind'][]).map(
        (kind) => html`<button type="button" class="plain" ?disabled=${full} aria-pressed=${placing === kind} @click=${() => choose(kind)}>${MARKS[kind].name}</button>`,
      )}
    </div>
    <p class="about" role="status">${told(app, full)}</p>
    ${all.map((mark, i) => entry(app, mark, i))}`;
}

function told({ placing, marks: all }: App, full: boolean): string {
  if (full) return `A face has at most ${MAX_MARKS} marks.`;
  const what = typeof placing === 'number' ? (all[placing]?.kind ?? 'scar') : placing;
  if (what !== undefined)
    return `Click on the face where the ${MARKS[what].name.toLowerCase()} goes; or turn the head with the arrow keys until the position is in the middle of the picture, and press Enter.`;
  return all.length === 0 ? 'Choose a mark, then click on the face.' : 'You can lengthen, turn and remove marks.';
}

/** Renders the controls of one mark. */
function entry(app: App, mark: FaceMark, i: number): TemplateResult {
  const { name } = MARKS[mark.kind];
  const title = `${name} ${i + 1}`;
  const changed = (change: Partial<FaceMark>): readonly FaceMark[] => app.marks.map((m, k) => (k === i ? { ...m, ...change } : m));
  const field = (label: string, value: number, [min, max]: readonly [number, number], step: number, unit: string, change: (value: number) => Partial<FaceMark>): TemplateResult =>
    numberField({
      label,
      of: title,
      value,
      min,
      max,
      step,
      unit,
      set: (to) => app.move({ kind: 'marks', marks: changed(change(to)), what: `${name.toLowerCase()}: ${label.toLowerCase()}` }),
      done: () => app.done(),
    });
  const alter = (change: Partial<FaceMark>, what: string): void => {
    app.do({ kind: 'marks', marks: changed(change), what });
  };
  const move = (): void => {
    app.placing = app.placing === i ? undefined : i;
    app.redraw();
  };
  const gone = (): void => {
    app.do({ kind: 'marks', marks: app.marks.filter((_, k) => k !== i), what: `${name.toLowerCase()} removed` });
  };
  return html`<section class="region" aria-label=${title}><h3>${title}</h3>
    ${field('Length', 1000 * mark.size, [2, 1000 * MAX_MARK_LENGTH], 1, 'mm', (mm) => ({ size: mm / 1000 }))}
    ${mark.kind === 'mole' ? nothing : field('Turned', mark.turn / DEGREE, [-180, 180], 5, '°', (degrees) => ({ turn: degrees * DEGREE }))}
    ${field('Strength', 100 * (mark.strength ?? 1), [10, 100], 5, '%', (percent) => ({ strength: percent / 100 }))}
    ${mark.kind === 'tattoo' ? motif(mark, title, alter) : nothing}
    <div class="group">
      <button type="button" class="plain" aria-label="Move ${title.toLowerCase()}" aria-pressed=${app.placing === i} @click=${move}>Move</button>
      <button type="button" class="plain" aria-label="Remove ${title.toLowerCase()}" @click=${gone}>Remove</button>
    </div>
  </section>`;
}

function motif(mark: FaceMark, title: string, alter: (change: Partial<FaceMark>, what: string) => void): TemplateResult {
  const shape = mark.shape ?? 'star';
  return html`<label class="select side"><span>Motif</span><select aria-label="Motif of ${title.toLowerCase()}" @change=${(event: Event) => {
    const to = (event.target as HTMLSelectElement).value as TattooShape;
    alter({ shape: to, ...(to === 'text' ? { text: mark.text ?? 'Mom' } : {}) }, `tattoo: ${SHAPES[to].toLowerCase()}`);
  }}>${(Object.entries(SHAPES) as [TattooShape, string][]).map(([key, name]) => html`<option value=${key} .selected=${key === shape}>${name}</option>`)}</select></label>
    ${shape === 'text' ? html`<label class="select side"><span>Letters</span><input type="text" maxlength=${MAX_LETTERS} .value=${mark.text ?? ''} autocomplete="off" @change=${(event: Event) => alter({ text: (event.target as HTMLInputElement).value }, 'tattoo: letters')} /></label>` : nothing}`;
}
