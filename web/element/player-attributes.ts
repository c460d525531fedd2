/** What a page says of a storyteller by attributes, besides those of a media element. */

import { attributes } from './media/attributes.js';
import { MediaElement } from './media-element.js';
import type { Backend, Hand, Quality } from './base/types.js';

/** A property for each of `attributes`, with what it is without one; `assets` is the player's, which knows where its script lies. */
export abstract class PlayerAttributes extends MediaElement {
  static override properties = attributes;

  /**
   * Name of a figure of the library, or the address of a `.glb` or `.vrm`. Without it the figure that
   * the story chooses performs (`r:performer`), else `sofia`; `currentFigure` tells who does. The
   * figure before stays on stage until this one is ready, and for good when it cannot be used.
   */
  declare figure: string | undefined;
  /** The dominant hand of who performs; otherwise the story says it, or else the figure. */
  declare handedness: Hand | undefined;
  /** Address (`ws:` or `wss:`) of a mind: EML that it sends is performed, and it receives events. See docs/live.md. */
  declare mind: string | undefined;
  /**
   * Who says what has no recording. `here`, the default: an engine in the page where one speaks the language, which
   * is fetched when such a thing is played, else the browser's own voice. `browser`: the browser's own voice alone.
   */
  declare speech: 'here' | 'browser';
  /** Address of the asset library, which holds `figures/`; by default the folder `assets/` beside the script. */
  declare assets: string;
  /** A picture to show before the story is played, and where none can be drawn. */
  declare poster: string | undefined;
  /**
   * Address of a film of the story, as `raconteur render --video` makes it, or several of the same film in other
   * encodings with spaces between them: shown in time with the sound where no picture can be drawn, fetched only there.
   */
  declare film: string | undefined;
  /** What the player is called by screen readers; say which story it tells. */
  declare label: string;
  /** Forces a back end; by default WebGPU where the browser has it. */
  declare backend: Backend | undefined;
  /** How much work goes into a picture; `auto`, the default, follows what the device can do. */
  declare quality: Quality;
  /** `lazy` loads when the player comes near the window, `eager` at once. */
  declare loading: 'lazy' | 'eager';
  /** Shows what is said. */
  declare captions: boolean;
  /** Lists what is wrong with story, voice and figure over the stage, folded: for those who write them. */
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
