/** Input fields shared by the viewer, the gesture workshop and the face page. */

import { html, nothing, type TemplateResult } from 'lit';
import { Directive, directive, type ElementPart } from 'lit/directive.js';
import { live } from 'lit/directives/live.js';

/** Directive that sets CSS custom properties without a `style` attribute, which a strict policy forbids. */
export const vars = directive(
  class extends Directive {
    override update(part: ElementPart, [values]: [Readonly<Record<string, string>>]): void {
      const { style } = part.element as HTMLElement;
      for (const [name, value] of Object.entries(values)) style.setProperty(name, value);
    }

    render(_values: Readonly<Record<string, string>>): void {}
  },
);

/** Receiver of a control's values: while it moves, and at rest. One movement is one step of undo. */
export interface Sink<T> {
  set(value: T): void;
  done(): void;
}

/** A number between the ends of a slider. */
export interface NumberField extends Sink<number> {
  readonly label: string;
  readonly value: number;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  /** Unit shown after the number. */
  readonly unit?: string;
  /** Text for screen readers instead of the slider's number. */
  readonly text?: string;
}

interface OwnedField extends NumberField {
  /** Owner of the number for screen readers, if the label alone is ambiguous. */
  readonly of?: string;
}

/** Renders a slider with a number field, limited to the slider's range. */
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
    <span class="exact"><input type="number" aria-label="${name}, exactly" min=${min} max=${max} step=${step} .value=${String(shown)} @change=${(event: Event) => {
      take(event);
      field.done();
    }} />${unit === '' ? nothing : html`<span aria-hidden="true">${unit}</span>`}</span>
  </div>`;
}

/** Renders a check box. */
export function check(label: string, on: boolean, set: (on: boolean) => void, note?: string): TemplateResult {
  return html`<label class="check"><input type="checkbox" .checked=${live(on)} @change=${(event: Event) => set((event.target as HTMLInputElement).checked)} /><span>${label}${note === undefined ? nothing : html`<small>${note}</small>`}</span></label>`;
}

/** Renders a choice of a few words, side by side. */
export function choice<T extends string>(name: string, label: string, value: T | undefined, options: Readonly<Record<T, string>>, choose: (value: T) => void): TemplateResult {
  return html`<fieldset class="choice">
    <legend>${label}</legend>
    <div>
      ${(Object.entries(options) as [T, string][]).map(
        ([word, text]) => html`<label><input type="radio" name=${name} value=${word} .checked=${live(word === value)} @change=${() => choose(word)} /><span>${text}</span></label>`,
      )}
    </div>
  </fieldset>`;
}

const WAYS: Readonly<Record<string, [right: number, up: number, ahead: number]>> = {
  ArrowLeft: [-1, 0, 0],
  ArrowRight: [1, 0, 0],
  ArrowUp: [0, 1, 0],
  ArrowDown: [0, -1, 0],
  PageUp: [0, 0, 1],
  PageDown: [0, 0, -1],
};

/** Converts arrow keys to steps to the right, upwards, and (Page Up and Page Down) ahead: 1, or 5 with the Shift key. */
export function keySteps(event: KeyboardEvent): [right: number, up: number, ahead: number] | undefined {
  const way = event.ctrlKey || event.metaKey || event.altKey ? undefined : WAYS[event.key];
  const step = event.shiftKey ? 5 : 1;
  return way && [way[0] * step, way[1] * step, way[2] * step];
}

/** Follows a pointer from its press to its release. */
export function follow(event: PointerEvent, frame: Element, move: (spot: { x: number; y: number }, rect: DOMRect, event: PointerEvent) => void, done: () => void): void {
  if (event.button !== 0) return;
  const target = event.currentTarget as HTMLElement;
  event.preventDefault();
  target.focus({ preventScroll: true });
  // A pointer that leaves is still followed; one that is gone already cannot be.
  try {
    target.setPointerCapture(event.pointerId);
  } catch {
    return;
  }
  const moved = (e: PointerEvent): void => {
    const rect = frame.getBoundingClientRect();
    move({ x: e.clientX - rect.left, y: e.clientY - rect.top }, rect, e);
  };
  const end = (): void => {
    target.removeEventListener('pointermove', moved);
    target.removeEventListener('lostpointercapture', end);
    done();
  };
  target.addEventListener('pointermove', moved);
  target.addEventListener('lostpointercapture', end);
}
