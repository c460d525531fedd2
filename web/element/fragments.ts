/** Live performance: EML that joins the story while it plays (docs/live.md). */

import { captionsOf } from './captions.js';
import { dispatch, type PlayerContext } from './context.js';
import { passCue } from './cues.js';
import type { Show } from './show.js';
import { substituteVoice, updateMusic } from './sound.js';
import type { Answer } from './types.js';

/** Senders of fragments, as the engine tells them apart. */
export const Sender = { Page: 0, Mind: 1 } as const;
/** What comes now begins this much later, so that its sound can be fetched. */
const LIVE_LEAD_SECS = 0.1;

/** Performs a fragment now; returns accepted and refused clauses. */
export function performFragment(context: PlayerContext, show: Show, sender: number, fragment: string): readonly Answer[] {
  const { player } = context;
  const nowSecs = show.transport.position + LIVE_LEAD_SECS;
  const performed = show.picture.perform(sender, String(fragment), nowSecs);
  if (performed === undefined) return [{ kind: 'failed', timeSecs: nowSecs, code: 'live::absent', message: 'The storyteller is away for a moment.' }];
  if (performed.utterances.length > 0) show.captions = captionsOf(show.script.add(performed, nowSecs));
  void substituteVoice(context, show, () => undefined);
  updateMusic(context, show);
  if (performed.endSecs > show.transport.endSecs) {
    show.transport.extend(performed.endSecs);
    dispatch(player, 'durationchange');
  }
  for (const event of performed.events) if (event.kind !== 'accepted') passCue(context, event, show);
  player.requestUpdate();
  return performed.events;
}
