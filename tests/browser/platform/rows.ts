/** Tests of https://github.com/web-platform-tests/wpt as data: the question, and the answer that the specification expects. */

import type { Kit } from '../media-kit.js';

/** Reference element for the player. */
export type Video = HTMLVideoElement & { captureStream(): MediaStream };

export interface Row {
  /**
   * Test file, relative to `html/semantics/embedded-content/media-elements/` or, with a leading slash, to the root; then the subtest. `specification` marks
   * rows that none of them covers.
   */
  readonly test: string;
  /** Query of the media element; runs in the page. */
  readonly ask: (kit: Kit<Video>, given: never) => unknown;
  readonly given?: unknown;
  readonly expected: unknown;
  /** Reason why the browser's own element is not asked, or deviates from the expected answer. */
  readonly uncontrolled?: string;
}

export interface Theme {
  readonly name: string;
  /** Element that gives the browser's own answer. */
  readonly control: 'audio' | 'video';
  /** True if the rows need an image. */
  readonly seen?: boolean;
  readonly rows: readonly Row[];
}
