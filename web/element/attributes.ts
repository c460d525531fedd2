/** The attributes of the element and how they become properties. Numbers that a page must not set are refused by the setters (`media.ts`). */

import type { PropertyDeclarations } from 'lit';
import { rateFrom, volumeFrom } from './media.js';

const text = { reflect: true };
const flag = { type: Boolean, reflect: true };

export const attributes: PropertyDeclarations = {
  src: text,
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
  controls: flag,
  captions: flag,
  remarks: flag,
  autoplay: flag,
  muted: flag,
  loop: flag,
  volume: { reflect: true, converter: volumeFrom },
  playbackRate: { reflect: true, attribute: 'playback-rate', converter: rateFrom },
};
