/** Inputs that every panel uses, as templates. */

import { html, nothing, type TemplateResult } from 'lit';
import { Directive, directive, type ElementPart } from 'lit/directive.js';

/** Sets custom properties of CSS. An attribute `style` is what a strict policy refuses; this is no attribute. */
export const vars = directive(
  class extends Directive {
    override update(part: ElementPart, [values]: [Readonly<Record<string, string>>]): void {
      const { style } = part.element as HTMLElement;
      for (const [name, value] of Object.entries(values)) style.setProperty(name, value);
    }

    render(_values: Readonly<Record<string, string>>): void {}
  },
);

/** Shows a number in an input, unless it is there already in other letters: who types `1.50` keeps the zero. */
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

/** What a control does with a value: while it moves, and once it rests. One move is one step of undo. */
export interface Sink<T> {
  set(value: T): void;
  done(): void;
}

export interface NumberField extends Sink<number> {
  readonly label: string;
  readonly value: number;
  readonly min: number;
  readonly max: number;
  readonly step: number;
  /** What stands behind the number. */
  readonly unit?: string;
  /** What the slider says instead of its number. */
  readonly text?: string;
}

const round = (value: number): number => Number(value.toFixed(3));

/** A slider with its number beside it. The number may go beyond the slider's ends. */
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

/** One of a few words, side by side. */
export function choice<T extends string>(name: string, label: string, value: T | undefined, options: Readonly<Record<T, string>>, choose: (value: T) => void): TemplateResult {
  return html`<fieldset class="choice">
    <legend>${label}</legend>
    <div>
      ${(Object.entries(options) as [T, string][]).map(
        ([word, text]) =>
          html`<label><input type="radio" name=${name} value=${word} .checked=${word === value} @change=${() => choose(word)} /><span>${text}</span></label>`,
      )}
    </div>
  </fieldset>`;
}

/** A handle that is dragged, or moved with the arrow keys. */
export interface Handle {
  /** What a screen reader says. */
  readonly label: string;
  readonly classes: string;
  /** Where it is, percent of its frame. */
  readonly left: number;
  readonly top: number;
  /** Where it was taken to: pixels of the frame, from its upper left corner. */
  drag(spot: { x: number; y: number }, frame: DOMRect, event: PointerEvent): void;
  /** A key; true when it was used. Steps are 1, or 5 with the shift key. */
  key(right: number, up: number, ahead: number): boolean;
  done(): void;
}

/** Arrow keys as steps to the right, upwards, and (page up and down) to the audience. */
export function keySteps(event: KeyboardEvent): [number, number, number] | undefined {
  if (event.ctrlKey || event.metaKey || event.altKey) return undefined;
  const step = event.shiftKey ? 5 : 1;
  switch (event.key) {
    case 'ArrowLeft':
      return [-step, 0, 0];
    case 'ArrowRight':
      return [step, 0, 0];
    case 'ArrowUp':
      return [0, step, 0];
    case 'ArrowDown':
      return [0, -step, 0];
    case 'PageUp':
      return [0, 0, step];
    case 'PageDown':
      return [0, 0, -step];
    default:
      return undefined;
  }
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

/** A handle over a frame, the nearest `.frame` around it. */
export function handle(it: Handle): TemplateResult {
  const press = (event: PointerEvent): void => {
    const frame = (event.currentTarget as HTMLElement).closest('.frame');
    if (frame !== null) follow(event, frame, (spot, rect, e) => it.drag(spot, rect, e), () => it.done());
  };
  const key = (event: KeyboardEvent): void => {
    const steps = keySteps(event);
    if (steps === undefined || !it.key(...steps)) return;
    event.preventDefault();
    it.done();
  };
  return html`<button type="button" class="handle ${it.classes}" aria-label=${it.label} ${vars({ '--left': `${it.left}%`, '--top': `${it.top}%` })} @pointerdown=${press} @keydown=${key}></button>`;
}
