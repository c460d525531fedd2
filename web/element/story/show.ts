/** Loaded story and its playback state. */

import type { Voice } from '../sound/voice.js';
import type { Caption } from '../captions/captions.js';
import type { LiveScript } from '../engine/live.js';
import type { StoryFiles } from '../engine/loader.js';
import type { Picture } from '../picture/picture.js';
import type { Transport } from '../media/transport.js';
import type { Statistics, Story } from '../base/types.js';

/** The loaded story and its playback. */
export interface Show {
  /** Story with the times of the current figure. */
  story: Story;
  /** Name of the figure on stage. */
  figure: string;
  choice: string | undefined;
  files: StoryFiles;
  /** Start of loading, on the page's clock. */
  readonly sinceMs: number;
  /** Speech of the story and of live fragments. */
  readonly script: LiveScript;
  captions: readonly Caption[];
  readonly picture: Picture;
  readonly voice: Voice;
  readonly transport: Transport;
  /** Controller of the current fragments, replaced when they are interrupted. */
  turn: AbortController;
  /** True if the story has no end because lines may always arrive. */
  readonly openEnded: boolean;
  /** Number of narrations in progress: the clock does not stop while their text is missing. */
  tellings: number;
  /** Controller that cancels pending work for the show. */
  readonly end: AbortController;
  /** Speech bundle included with the story. */
  readonly recorded: Uint8Array | undefined;
  /** Synthesis in progress, and the work that depends on it. */
  speaking?: Promise<void>;
  /** State of the speech synthesis of the text on stage by the page's own voice. */
  telling?: Narration | undefined;
  /** Browser voice used for utterances without a recording, or none. */
  lent?: { readonly name: Promise<string | undefined> };
  /** True if some speech is inaudible: captions are then shown even if not requested. */
  unheard?: boolean;
  /** True if the user has hidden captions that were not requested. */
  refusesCaptions?: boolean;
}

/** Synthesis of a text by the page's own voice. */
export interface Narration {
  /** The figure and the text. */
  readonly of: string;
  readonly end: AbortController;
  /** True if everything was spoken, or failed. */
  isOver: boolean;
}

/** Returns true if captions are shown: on request, or if speech is inaudible. */
export const hasCaptions = ({ captions }: { readonly captions: boolean }, show: Show | undefined): boolean => captions || (show?.unheard === true && !show.refusesCaptions);

/** Returns times, sizes and draw calls, after the first frame. */
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
