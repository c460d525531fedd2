/** Values, texts and states of a media element, by the HTML standard's interface. */

import { RATES } from '../base/clock.js';

const states = {
  NETWORK_EMPTY: 0,
  NETWORK_IDLE: 1,
  NETWORK_LOADING: 2,
  NETWORK_NO_SOURCE: 3,
  HAVE_NOTHING: 0,
  HAVE_METADATA: 1,
  HAVE_CURRENT_DATA: 2,
  HAVE_FUTURE_DATA: 3,
  HAVE_ENOUGH_DATA: 4,
} as const;

/** The constants of `readyState` and `networkState`. */
export type MediaStates = typeof states;

/** Adds these constants to a class and its instances. */
export function addStates(element: { prototype: object }): void {
  for (const target of [element, element.prototype]) {
    for (const [name, value] of Object.entries(states)) Object.defineProperty(target, name, { value, enumerable: true });
  }
}

/** Returns a value as a `double` of the interface; throws `TypeError` if it is not finite. */
export function finite(name: string, value: unknown): number {
  const number = Number(value);
  if (!Number.isFinite(number)) throw new TypeError(`Failed to set '${name}': the value is not a finite number.`);
  return number;
}

/** Checks and returns the `volume` set by a page. */
export function checkedVolume(value: unknown): number {
  const number = finite('volume', value);
  if (number < 0 || number > 1) throw new DOMException(`Failed to set 'volume': ${number} is outside the range 0 to 1.`, 'IndexSizeError');
  return number;
}

/** Checks and returns the `playbackRate` or `defaultPlaybackRate` set by a page. */
export function checkedRate(value: unknown, name = 'playbackRate'): number {
  const number = finite(name, value);
  if (number !== 0 && (number < RATES.min || number > RATES.max)) {
    throw new DOMException(`Failed to set '${name}': ${number} is outside the range ${RATES.min} to ${RATES.max}, and not 0.`, 'NotSupportedError');
  }
  return number;
}

/** Returns a converter for an attribute; an invalid value counts as a missing attribute. */
const from = (check: (value: unknown) => number) => ({
  fromAttribute(value: string | null): number {
    try {
      return value === null || value.trim() === '' ? 1 : check(value);
    } catch {
      return 1;
    }
  },
});

/** Lit converters of the two attributes. */
export const volumeFrom = from(checkedVolume);
export const rateFrom = from(checkedRate);

/** Parses `preload`: a missing or unknown value is `metadata`. */
export function preloadOf(attribute: string | null): 'none' | 'metadata' | 'auto' {
  const word = attribute?.toLowerCase();
  if (word === '') return 'auto';
  return word === 'none' || word === 'auto' ? word : 'metadata';
}

/** Parses `crossorigin`: the credentials mode for other origins. */
export function crossOriginOf(attribute: string | null): 'anonymous' | 'use-credentials' | null {
  if (attribute === null) return null;
  return attribute.toLowerCase() === 'use-credentials' ? 'use-credentials' : 'anonymous';
}

/** Returns the likelihood that a story of a MIME type can be played. */
export function canPlay(type: string): CanPlayTypeResult {
  const name = type.split(';')[0]?.trim().toLowerCase();
  if (name === 'application/eml+xml') return 'probably';
  return name === 'application/xml' || name === 'text/xml' ? 'maybe' : '';
}
