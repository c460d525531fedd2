/**
 * The attributes of the element and how they become properties. Numbers that a page must not set are refused by the setters (`media.ts`).
 * Attributes are the page's: a property is written to its attribute only where those of HTML's media elements are, which are the attribute.
 */

import type { PropertyDeclarations } from 'lit';
import { rateFrom, volumeFrom } from './media.js';

const text = {};
const flag = { type: Boolean };
/** The property is the attribute itself, as those of media elements are. */
const itself = { noAccessor: true };

/** Attributes of a media element. */
export const mediaAttributes: PropertyDeclarations = {
  src: itself,
  preload: itself,
  crossOrigin: { ...itself, attribute: 'crossorigin' },
  autoplay: itself,
  controls: itself,
  loop: itself,
  defaultMuted: { ...itself, attribute: 'muted' },
  disablePictureInPicture: { ...itself, attribute: 'disablepictureinpicture' },
  playsInline: { ...itself, attribute: 'playsinline' },
  muted: { attribute: false },
  volume: { converter: volumeFrom },
  playbackRate: { attribute: 'playback-rate', converter: rateFrom },
};

/** Properties of a media element that reflect attributes, by attribute; `muted` is not among them, because its attribute is only the initial state. */
export const THEMSELVES: ReadonlyMap<string, string> = new Map([
  ['src', 'src'],
  ['preload', 'preload'],
  ['crossorigin', 'crossOrigin'],
  ['autoplay', 'autoplay'],
  ['controls', 'controls'],
  ['loop', 'loop'],
  ['disablepictureinpicture', 'disablePictureInPicture'],
  ['playsinline', 'playsInline'],
]);

/** Attributes of a storyteller. */
export const attributes: PropertyDeclarations = {
  figure: text,
  handedness: text,
  mind: text,
  speech: text,
  assets: text,
  poster: text,
  film: text,
  label: text,
  backend: text,
  quality: text,
  loading: text,
  captions: flag,
  remarks: flag,
};
