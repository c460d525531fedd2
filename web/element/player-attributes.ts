/** Attributes of a storyteller in addition to those of a media element. */

import { attributes } from './media/attributes.js';
import { MediaElement } from './media-element.js';
import type { Backend, Hand, Quality } from './base/types.js';

/**
 * A property for each entry of `attributes`, with its default; `assets` gets its default from the player, which knows
 * its script's address.
 */
export abstract class PlayerAttributes extends MediaElement {
  static override properties = attributes;

  /**
   * Name of a figure in the library, or the address of a `.glb` or `.vrm`. Without it, the figure that the story
   * chooses performs (`r:performer`), else `sofia`; `currentFigure` is the current one. The previous figure stays on
   * stage until this one is ready, and permanently if this one cannot be used.
   */
  declare figure: string | undefined;
  /** Dominant hand of the performer; by default the story's, else the figure's. */
  declare handedness: Hand | undefined;
  /**
   * Address (`ws:` or `wss:`) of a mind. The player performs the EML that it sends, and sends it events. See
   * docs/live.md.
   */
  declare mind: string | undefined;
  /**
   * Speech source for text without a recording. `here`, the default: an engine in the page if one speaks the language,
   * fetched when such a text is played; otherwise the browser's own voice. `browser`: only the browser's own voice.
   */
  declare speech: 'here' | 'browser';
  /** Address of the asset library, which contains `figures/`; by default the folder `assets/` next to the script. */
  declare assets: string;
  /** Address of an image that is shown before the story is played, and if rendering is impossible. */
  declare poster: string | undefined;
  /**
   * Address of a film of the story, as written by `raconteur render --video`, or several addresses of the same film in
   * other encodings, separated by spaces. If rendering is impossible, the film is fetched and shown in sync with the
   * audio.
   */
  declare film: string | undefined;
  /** Accessible name of the player. Name the story that it performs. */
  declare label: string;
  /** Forces a rendering back end; by default WebGPU if the browser has it. */
  declare backend: Backend | undefined;
  /** Rendering quality; `auto`, the default, follows the device's performance. */
  declare quality: Quality;
  /** `lazy` loads when the player comes near the viewport, `eager` immediately. */
  declare loading: 'lazy' | 'eager';
  /** Shows captions: the story's own, or the subtitles of a `<track>` element that the user or the page has chosen. */
  declare captions: boolean;
  /** Shows a collapsed list of problems of story, voice and figure over the stage, for authors. */
  declare remarks: boolean;

  constructor() {
    super();
    this.quality = 'auto';
    this.speech = 'here';
    this.label = 'Story';
    this.loading = 'lazy';
    this.captions = this.remarks = false;
  }
}
