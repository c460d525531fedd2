/** The story's clock: a straight line from the time of a source (the sound's) to story time. */

/** Minimum and maximum playback rate; at 0 the time does not advance. */
export const RATES = { min: 0.25, max: 4 } as const;

/**
 * Maps source time to story time. While it runs, story time is
 * `position + rate × (source − anchor)`; before the anchor, and while it rests, it is `position`.
 */
export class StoryClock {
  #position = 0;
  #anchor = 0;
  #rate = 1;
  #running = false;

  get running(): boolean {
    return this.#running;
  }

  get rate(): number {
    return this.#rate;
  }

  /** Returns the story time at a time of the source. */
  storyTimeAt(source: number): number {
    if (!this.#running) return this.#position;
    return this.#position + this.#rate * Math.max(0, source - this.#anchor);
  }

  /** Returns the time of the source at a story time. */
  sourceAt(story: number): number {
    return this.#anchor + (story - this.#position) / this.#rate;
  }

  /** Runs from `position` at the source's time `anchor`. */
  start(position: number, anchor: number, rate: number): void {
    this.#position = position;
    this.#anchor = anchor;
    this.#rate = clampRate(rate);
    this.#running = true;
  }

  /** Rests at `position`. */
  rest(position: number): void {
    this.#position = position;
    this.#running = false;
  }
}

/** Returns the nearest playable speed, 0 included; 1 for NaN. */
export function clampRate(rate: number): number {
  if (rate === 0) return 0;
  return Number.isFinite(rate) ? Math.min(RATES.max, Math.max(RATES.min, rate)) : 1;
}

/** Formats a time as `1:05`, or as `1:02:05` from an hour on. */
export function formatTime(secs: number): string {
  const whole = Number.isFinite(secs) ? Math.max(0, Math.floor(secs)) : 0;
  const two = (n: number) => String(n).padStart(2, '0');
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`;
}

type Unit = 'hour' | 'minute' | 'second';

/** Cache of number formats: creating one takes longer than all the rest, and the bar is rendered often. */
const formats = new Map<string, Intl.NumberFormat>();

function formatOf(language: string, unit: Unit): Intl.NumberFormat {
  const name = `${language} ${unit}`;
  const known = formats.get(name);
  if (known !== undefined) return known;
  const options = { style: 'unit', unit, unitDisplay: 'long' } as const;
  let made: Intl.NumberFormat;
  try {
    made = new Intl.NumberFormat(language, options);
  } catch {
    // The language that the page specifies is invalid.
    made = new Intl.NumberFormat('en', options);
  }
  formats.set(name, made);
  return made;
}

/** Formats a time for reading aloud in a language (a BCP 47 tag): `1 minute 5 seconds`. */
export function spokenTime(secs: number, language = 'en'): string {
  const whole = Number.isFinite(secs) ? Math.max(0, Math.floor(secs)) : 0;
  const unit = (n: number, name: Unit) => formatOf(language, name).format(n);
  const parts = [
    [Math.floor(whole / 3600), 'hour'],
    [Math.floor(whole / 60) % 60, 'minute'],
    [whole % 60, 'second'],
  ] as const;
  const said = parts.filter(([n]) => n > 0).map(([n, name]) => unit(n, name));
  return said.length === 0 ? unit(0, 'second') : said.join(' ');
}
