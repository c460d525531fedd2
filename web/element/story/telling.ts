/** Begins to tell plain words; the part that tells them is fetched for that. */

import type { PlayerContext } from './context.js';
import type { Show } from './show.js';
import type { NarrationHandle, Words } from '../base/types.js';

/** Tells words on a stage that may still have to be opened; `interrupt` ends what is being said. */
export function telling(context: PlayerContext, stage: Promise<Show>, words: Words, interrupt: () => void): NarrationHandle {
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
