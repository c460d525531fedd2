/** Inputs of the viewer's panels, as templates. */

import { html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import { aboutClip, clipTitle, SHELVED } from './clips.js';

/** Renders a menu of words. */
export function menu<T extends string>(label: string, value: T, options: Readonly<Record<T, string>>, choose: (value: T) => void): TemplateResult {
  return html`<label class="select"><span>${label}</span>
    <select aria-label=${label} .value=${live(value)} @change=${(event: Event) => choose((event.target as HTMLSelectElement).value as T)}>
      ${(Object.entries(options) as [T, string][]).map(([word, text]) => html`<option value=${word} .selected=${word === value}>${text}</option>`)}
    </select></label>`;
}

/** Renders a menu of the library's animations, with the description of the chosen one. */
export function clipMenu(label: string, value: string, none: string | undefined, choose: (clip: string) => void): TemplateResult {
  return html`<label class="select clip"><span>${label}</span>
    <select aria-label=${label} title=${aboutClip(value)} @change=${(event: Event) => choose((event.target as HTMLSelectElement).value)}>
      ${none === undefined ? nothing : html`<option value="" .selected=${value === ''}>${none}</option>`}
      ${SHELVED.map(
        ({ shelf, clips }) =>
          html`<optgroup label=${shelf}>${clips.map(({ name }) => html`<option value=${name} .selected=${name === value}>${clipTitle(name)}</option>`)}</optgroup>`,
      )}
    </select></label>`;
}
