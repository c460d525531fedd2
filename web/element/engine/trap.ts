/** Activity of a trapped engine, as a sentence with the file's name. */

import { doingOf, panicOf } from './backend.js';
import { shown } from '../base/fetching.js';
import type { StoryFiles } from './loader.js';
import type { Engine } from '../base/engine.js';
import { PlayerError } from '../base/types.js';

/** Numbers returned by `doing` of `crate/web`. */
export const Doing = {
  Nothing: 0,
  Figure: 1,
  Story: 2,
  Speech: 3,
  Performance: 4,
  Animation: 5,
  Fragment: 6,
  Pose: 7,
  Drawing: 8,
} as const;

/** Returns true if an error is an engine trap: its memory is suspect, and it is not used again. */
export function isTrap(error: unknown): boolean {
  return error instanceof WebAssembly.RuntimeError || (error instanceof Error && error.cause instanceof WebAssembly.RuntimeError);
}

/** Describes an activity by the engine's number. */
export function describeDoing(
  doing: number,
  { figure, story, voiceFolder, edited }: Pick<StoryFiles, 'figure' | 'story' | 'voiceFolder' | 'edited'>,
  animations: readonly string[],
): string {
  const text = edited ? 'the text of the page' : shown(story);
  switch (doing) {
    case Doing.Figure:
      return `reading the figure ${figure.where}`;
    case Doing.Story:
      return `reading the story ${text}`;
    case Doing.Speech:
      return `reading the speech ${shown(new URL('speech.json', voiceFolder))}`;
    case Doing.Performance:
      return `planning the performance of the story ${text}`;
    case Doing.Animation: {
      const names = animations.slice(0, 3).join(', ');
      return `reading ${animations.length === 1 ? 'the animation' : 'the animations'} ${names}${animations.length > 3 ? ' …' : ''}`;
    }
    case Doing.Fragment:
      return 'reading a live fragment';
    case Doing.Pose:
      return `moving the figure ${figure.where} in the story ${text}`;
    case Doing.Drawing:
      return `drawing the figure ${figure.where}`;
    default:
      return `performing the story ${text}`;
  }
}

/** Returns the error for a trap: the engine's activity, and the message of its panic or else of the browser. */
export function trapError(engine: Engine, files: StoryFiles, error: unknown): PlayerError {
  const reason = (panicOf(engine) ?? (error instanceof Error ? error.message : String(error))).replace(/[.\s]+$/, '');
  const doing = describeDoing(doingOf(engine), files, files.animations.provided);
  return new PlayerError(`The player failed while ${doing}: ${reason}.`, { cause: error });
}
