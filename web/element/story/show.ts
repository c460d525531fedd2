/** What a player has loaded and plays. */

import type { Voice } from '../sound/voice.js';
import type { Caption } from '../captions/captions.js';
import type { LiveScript } from '../engine/live.js';
import type { StoryFiles } from '../engine/loader.js';
import type { Picture } from '../picture/picture.js';
import type { Transport } from '../media/transport.js';
import type { Statistics, Story } from '../base/types.js';

/** The loaded story and its playback. */
export interface Show {
  /** As the present figure tells it. */
  story: Story;
  /** Name of the figure on stage. */
  figure: string;
  choice: string | undefined;
  files: StoryFiles;
  /** When loading began, on the page's clock. */
  readonly sinceMs: number;
  /** What the story and live fragments say. */
  readonly script: LiveScript;
  captions: readonly Caption[];
  readonly picture: Picture;
  readonly voice: Voice;
  readonly transport: Transport;
  /** Until fragments are interrupted, and then of those that come after. */
  turn: AbortController;
  /** The time of the story has no end: lines may always come. */
  readonly openEnded: boolean;
  /** How many texts are told as they come: the clock does not stop for want of words. */
  tellings: number;
  /** Ends what is still being made for it. */
  readonly end: AbortController;
  /** The bundle that the story came with. */
  readonly recorded: Uint8Array | undefined;
  /** What is being spoken, and what waits for it. */
  speaking?: Promise<void>;
  /** How the page's own voice tells the text on stage. */
  telling?: Narration | undefined;
  /** What has no recording was given to the browser's voice of this name, or to nobody. */
  lent?: { readonly name: Promise<string | undefined> };
  /** Something that is said is not heard: captions are shown, also where nobody has asked for them. */
  unheard?: boolean;
  /** Somebody has put away captions that nobody had asked for. */
  refusesCaptions?: boolean;
}

/** A text that the page's own voice tells. */
export interface Narration {
  /** The figure and the text. */
  readonly of: string;
  readonly end: AbortController;
  /** All was said, or could not be. */
  isOver: boolean;
}

/** Whether what is said can be read: where somebody has asked for that, and where it is not heard. */
export const hasCaptions = ({ captions }: { readonly captions: boolean }, show: Show | undefined): boolean => captions || (show?.unheard === true && !show.refusesCaptions);

/** Times, bytes and draw calls, once a picture was shown. */
export function statisticsOf({ picture, files, sinceMs }: Show): Statistics | undefined {
  const drawn = picture.statistics;
  if (drawn === undefined || picture.firstShownMs === undefined) return undefined;
  const { eml, bundle, figure } = files;
  return {
    ...drawn,
    firstFrameMs: picture.firstShownMs - sinceMs,
    bytes: { story: new TextEncoder().encode(eml).length, voice: bundle?.length ?? 0, figure: figure.glb.length },
  };
}
