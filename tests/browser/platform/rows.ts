/** Tests of https://github.com/web-platform-tests/wpt as facts: what is asked, and what the specification expects. */

import type { Kit } from '../media-kit.js';

/** What the player is measured against. */
export type Video = HTMLVideoElement & { captureStream(): MediaStream };

export interface Row {
  /** The file, below `html/semantics/embedded-content/media-elements/` or, with a slash first, below the root; then the subtest. `specification` stands for what none of them asks. */
  readonly test: string;
  /** It runs in the page. */
  readonly ask: (kit: Kit<Video>, given: never) => unknown;
  readonly given?: unknown;
  readonly expected: unknown;
  /** Why the browser's own element is not asked, or does not answer as expected. */
  readonly uncontrolled?: string;
}

export interface Theme {
  readonly name: string;
  /** What the browser's own answer comes from. */
  readonly control: 'audio' | 'video';
  /** The rows need a picture. */
  readonly seen?: boolean;
  readonly rows: readonly Row[];
}
