/** Inputs of the viewer's panels, as templates. */

import { html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import type { NumberField } from '../fields.js';
import { aboutClip, clipTitle, SHELVED } from './clips.js';

interface OwnedField extends NumberField {
  /** What the number is said to belong to, where the label alone is not enough. */
  readonly of?: string;
}

/** A slider with its number beside it, which stays between the slider's ends. */
export function numberField(field: OwnedField): TemplateResult {
  const { label, value, min, max, step, unit = '', text, of } = field;
  const shown = Number(value.toFixed(2));
  const name = of === undefined ? label : `${label}, ${of}`;
  const take = (event: Event): void => {
    const { value: typed } = event.target as HTMLInputElement;
    const number = Number(typed);
    if (typed !== '' && Number.isFinite(number)) field.set(Math.min(max, Math.max(min, number)));
  };
  return html`<div class="number">
    <span class="name" aria-hidden="true">${label}</span>
    <input type="range" aria-label=${name} aria-valuetext=${text ?? `${shown} ${unit}`.trim()} min=${min} max=${max} step=${step} .value=${live(String(shown))} @input=${take} @change=${() => field.done()} />
    <span class="exact"><input type="number" aria-label="${name}, exactly" min=${min} max=${max} step=${step} .value=${String(shown)} @change=${(event: Event) => { take(event); field.done(); }} />${unit === '' ? nothing : html`<span aria-hidden="true">${unit}</span>`}</span>
  </div>`;
}

/** On or off. */
export function check(label: string, on: boolean, set: (on: boolean) => void, note?: string): TemplateResult {
  return html`<label class="check"><input type="checkbox" .checked=${live(on)} @change=${(event: Event) => set((event.target as HTMLInputElement).checked)} /><span>${label}${note === undefined ? nothing : html`<small>${note}</small>`}</span></label>`;
}

/** A menu of words. */
export function menu<T extends string>(label: string, value: T, options: Readonly<Record<T, string>>, choose: (value: T) => void): TemplateResult {
  return html`<label class="select"><span>${label}</span>
    <select aria-label=${label} .value=${live(value)} @change=${(event: Event) => choose((event.target as HTMLSelectElement).value as T)}>
      ${(Object.entries(options) as [T, string][]).map(([word, text]) => html`<option value=${word} .selected=${word === value}>${text}</option>`)}
    </select></label>`;
}

/** A menu of the library's animations, with what the chosen one shows. */
export function clipMenu(label: string, value: string, none: string | undefined, choose: (clip: string) => void): TemplateResult {
  return html`<label class="select clip"><span>${label}</span>
    <select aria-label=${label} title=${aboutClip(value)} @change=${(event: Event) => choose((event.target as HTMLSelectElement).value)}>
      ${none === undefined ? nothing : html`<option value="" .selected=${value === ''}>${none}</option>`}
      ${SHELVED.map(
        ({ shelf, clips }) => html`<optgroup label=${shelf}>${clips.map(({ name }) => html`<option value=${name} .selected=${name === value}>${clipTitle(name)}</option>`)}</optgroup>`,
      )}
    </select></label>`;
}
