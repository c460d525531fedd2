/** The 61 handshapes: their names and images, and a picker. */

import { html, type TemplateResult } from 'lit';
import { vars } from '../fields.js';
import { SHAPE_NAMES } from './shape-names.js';

/** Number of images per row of the sheet. */
const COLUMNS = 8;
const ROWS = Math.ceil(SHAPE_NAMES.length / COLUMNS);

export const shapeName = (id: number): string => SHAPE_NAMES[id] ?? 'unknown shape';

/** Renders the image of a handshape. */
export function shapePicture(id: number): TemplateResult {
  const [column, row] = [id % COLUMNS, Math.floor(id / COLUMNS)];
  return html`<span class="picture" ${vars({ '--x': `${(100 * column) / (COLUMNS - 1)}%`, '--y': `${(100 * row) / (ROWS - 1)}%` })}></span>`;
}

/** Renders all shapes as one group of radio buttons; arrow keys move through it as through any other. */
export function shapePicker(name: string, label: string, value: number | undefined, choose: (id: number) => void): TemplateResult {
  return html`<fieldset class="shapes">
    <legend>${label}</legend>
    <div>
      ${SHAPE_NAMES.map(
        (shape, id) => html`<label title="${id} ${shape}">
          <input type="radio" name=${name} value=${id} aria-label="${id} ${shape}" .checked=${id === value} @change=${() => choose(id)} />
          ${shapePicture(id)}<span class="id" aria-hidden="true">${id}</span>
        </label>`,
      )}
    </div>
  </fieldset>`;
}
