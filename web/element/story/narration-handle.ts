/** Starts a narration of plain text; fetches the code for it. */

import type { PlayerContext } from './context.js';
import type { Show } from './show.js';
import type { NarrationHandle, Words } from '../base/types.js';

/** Narrates text on a stage that may still be opening; `interrupt` ends the current speech. */
export function startNarration(context: PlayerContext, stage: Promise<Show>, words: Words, interrupt: () => void): NarrationHandle {
  const end = new AbortController();
  const tell = async (): Promise<void> => {
    const [{ tellWords }, show] = await Promise.all([import('./narration.js'), stage]);
    await tellWords(context, show, words, end.signal);
  };
  return {
    done: tell(),
    interrupt: () => {
      end.abort();
      interrupt();
    },
  };
}
