/** Amounts of each attribute in the edited face. */

import type { FacePart, Faces } from '../element/face/faces.js';
import type { Act } from './acts.js';

/** Values of the attributes of a face, by part. */
export type Values = Readonly<Record<FacePart, ReadonlyMap<string, number>>>;

/** Amount of an attribute below which it gives no estimate of the effect of more. */
const MIN_AMOUNT = 1e-3;

/** Reads the values on request, once per change of their part. */
export class AttributeReading {
  readonly #read = new Map<FacePart, ReadonlyMap<string, number>>();

  constructor(private readonly faces: Faces) {}

  /** Discards the stored values of the changed parts of the face. */
  changed(parts: readonly FacePart[]): void {
    for (const part of parts) this.#read.delete(part);
  }

  valuesOf(part: FacePart): ReadonlyMap<string, number> {
    const known = this.#read.get(part);
    if (known !== undefined) return known;
    const own = this.faces.pack.attributes.filter((a) => a.part === part);
    const values = this.faces.values(part);
    return this.describe(part, new Map(own.map((a, i) => [a.name, values[i] ?? 0])));
  }

  get all(): Values {
    return { shape: this.valuesOf('shape'), texture: this.valuesOf('texture') };
  }

  /** Sets values computed otherwise than by measuring the face. */
  describe(part: FacePart, values: ReadonlyMap<string, number>): ReadonlyMap<string, number> {
    this.#read.set(part, values);
    return values;
  }
}

/** Effect of an attribute on all values: they are linear in the face, so one measurement predicts any amount. */
export class AttributeSlopes {
  #key = '';
  #of: Values | undefined;

  constructor(private readonly from: Values) {}

  /** Sets in `reading` the values after an action that starts at `from`; does nothing if the face must be measured. */
  setFrom(reading: AttributeReading, act: Act): void {
    if (act.kind !== 'add') return;
    const { from } = this;
    const key = JSON.stringify({ ...act, amount: 1 });
    if (key !== this.#key || this.#of === undefined) {
      if (Math.abs(act.amount) < MIN_AMOUNT) return;
      const now = reading.all;
      const slope = (of: FacePart): Map<string, number> => new Map([...now[of]].map(([name, value]) => [name, (value - (from[of].get(name) ?? 0)) / act.amount]));
      this.#key = key;
      this.#of = { shape: slope('shape'), texture: slope('texture') };
      return;
    }
    for (const part of ['shape', 'texture'] as const) {
      reading.describe(part, new Map([...this.#of[part]].map(([name, slope]) => [name, (from[part].get(name) ?? 0) + slope * act.amount])));
    }
  }
}
