/** Live performance: EML that joins the story while it plays (docs/live.md). */

import { captionsOf } from '../captions/captions.js';
import { languageOf, type PlayerContext } from './context.js';
import { dispatch } from '../media/media-events.js';
import { passCue } from './cues.js';
import type { Show } from './show.js';
import { speakFragment, substituteVoice, updateMusic } from './sound.js';
import type { Answer, InterruptionOutcome } from '../base/performance.js';

/** Senders of fragments, as distinguished by the engine. */
export const Sender = { Page: 0, Mind: 1 } as const;
/** Delay of live content, so that its audio can be fetched. */
const LIVE_LEAD_SECS = 0.1;

/** The message that is no fragment but ends them. */
const INTERRUPT = /^\s*<interrupt\s*\/>\s*$/;
export const interrupts = (message: string): boolean => INTERRUPT.test(message);

/** Returns the answer about a fragment that was waiting when fragments were interrupted. */
export function dropped(timeSecs: number): readonly Answer[] {
  return [{ kind: 'failed', timeSecs, code: 'live::interrupted', message: 'Fragments were interrupted before this one was performed.' }];
}

/** Performs a fragment, immediately or after its synthesis in the page, unless it is interrupted meanwhile. */
export function perform(context: PlayerContext, show: Show, sender: number, fragment: string): readonly Answer[] | Promise<readonly Answer[]> {
  if (interrupts(fragment)) return performFragment(context, show, sender, fragment);
  const { signal } = show.turn;
  const performNow = () => (signal.aborted ? dropped(show.transport.position) : performFragment(context, show, sender, fragment));
  return speakFragment(context, show, fragment)?.then(performNow) ?? performNow();
}

/** Interrupts fragments; those awaiting synthesis are cancelled. */
export function interrupt(context: PlayerContext, show: Show): void {
  endTurn(show);
  const cut = show.picture.interrupt(show.transport.position);
  if (cut !== undefined) applyCut(context, show, cut);
}

function endTurn(show: Show): void {
  show.turn.abort();
  show.turn = new AbortController();
}

function applyCut(context: PlayerContext, show: Show, { atSecs, endSecs }: InterruptionOutcome): void {
  const changes = show.script.cut(atSecs);
  show.voice.cut(changes, atSecs);
  show.captions = captionsOf(show.script.byTime(), languageOf(context.player, show.story));
  updateMusic(context, show);
  show.transport.replace(Math.max(endSecs, show.transport.position), false);
  dispatch(context.player, 'durationchange');
  context.questioner.interrupted();
  context.advance();
}

/** Performs a fragment now; returns accepted and refused clauses. */
function performFragment(context: PlayerContext, show: Show, sender: number, fragment: string): readonly Answer[] {
  const { player } = context;
  const ends = interrupts(fragment);
  const nowSecs = show.transport.position + (ends ? 0 : LIVE_LEAD_SECS);
  if (ends) endTurn(show);
  const performed = show.picture.perform(sender, String(fragment), nowSecs);
  if (performed === undefined) return [{ kind: 'failed', timeSecs: nowSecs, code: 'live::absent', message: 'The storyteller is temporarily unavailable.' }];
  if (performed.cut !== undefined) applyCut(context, show, performed.cut);
  if (performed.utterances.length > 0) show.captions = captionsOf(show.script.add(performed, nowSecs), languageOf(player, show.story));
  context.questioner.lesson.add(performed.questions);
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
