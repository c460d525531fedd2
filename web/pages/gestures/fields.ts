/** Inputs of the workshop's panels, as templates. */

import { html, nothing, type TemplateResult } from 'lit';
import { Directive, directive, type ElementPart } from 'lit/directive.js';
import { follow, keySteps, vars, type NumberField } from '../fields.js';

/** Directive that shows a number in an input, unless the same number is there in another notation: a typed `1.50` keeps its zero. */
const shows = directive(
  class extends Directive {
    override update(part: ElementPart, [value]: [number]): void {
      const input = part.element as HTMLInputElement;
      const typing = input.matches(':focus') && input.type === 'number';
      if (input.value === '' ? !typing : Number(input.value) !== value) input.value = String(value);
    }

    render(_value: number): void {}
  },
);

const round = (value: number): number => Number(value.toFixed(3));

/** Renders a slider with a number field. The number may exceed the slider's range. */
export function numberField(field: NumberField): TemplateResult {
  const { label, value, min, max, step, unit = '', text } = field;
  const take = (event: Event): void => {
    const input = event.target as HTMLInputElement;
    if (input.value !== '' && Number.isFinite(Number(input.value))) field.set(Number(input.value));
  };
  const shown = round(value);
  return html`<div class="number">
    <span class="name" aria-hidden="true">${label}</span>
    <input type="range" aria-label=${label} aria-valuetext=${text ?? `${shown} ${unit}`.trim()} min=${min} max=${max} step=${step} ${shows(shown)} @input=${take} @change=${() => field.done()} />
    <span class="exact"><input type="number" aria-label="${label}, exactly" step=${step} ${shows(shown)} @input=${take} @change=${() => field.done()} />${unit === '' ? nothing : html`<span aria-hidden="true">${unit}</span>`}</span>
  </div>`;
}

/** A handle that is dragged, or moved with the arrow keys. */
export interface Handle {
  /** Label for screen readers. */
  readonly label: string;
  readonly classes: string;
  /** Horizontal position, percent of its frame. */
  readonly left: number;
  readonly top: number;
  /** Called with the dragged position: pixels of the frame, from its upper left corner. */
  drag(spot: { x: number; y: number }, frame: DOMRect, event: PointerEvent): void;
  /** Handles a key; returns true if it was used. Steps are 1, or 5 with the Shift key. */
  key(right: number, up: number, ahead: number): boolean;
  done(): void;
}

/** Renders a handle over a frame, the nearest `.frame` around it. */
export function handle(it: Handle): TemplateResult {
  const press = (event: PointerEvent): void => {
    const frame = (event.currentTarget as HTMLElement).closest('.frame');
    if (frame !== null)
      follow(
        event,
        frame,
        (spot, rect, e) => it.drag(spot, rect, e),
        () => it.done(),
      );
  };
  const key = (event: KeyboardEvent): void => {
    const steps = keySteps(event);
    if (steps === undefined || !it.key(...steps)) return;
    event.preventDefault();
    it.done();
  };
  return html`<button type="button" class="handle ${it.classes}" aria-label=${it.label} ${vars({ '--left': `${it.left}%`, '--top': `${it.top}%` })} @pointerdown=${press} @keydown=${key}></button>`;
}
