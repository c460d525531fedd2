/** Dispatch of a story's cues as events of the element. */

import { fire, wordsFor, type PlayerContext } from './context.js';
import { dispatch, takeBackSeek } from '../media/media-events.js';
import type { Show } from './show.js';
import type { TransportEvent } from '../media/transport.js';
import type { Cue } from '../base/performance.js';

/** Reports a cue to the mind and to the page. */
export function passCue({ player, diagnostics, notify: tell }: PlayerContext, cue: Cue, show: Show): void {
  tell(cue);
  if (cue.kind === 'word') {
    const word = show.script.utteranceAt(cue.utterance)?.words[cue.word];
    if (word !== undefined) fire(player, 'word', { word, utterance: cue.utterance, index: cue.word });
  } else if (cue.kind === 'clause' || cue.kind === 'storyevent' || cue.kind === 'phone' || cue.kind === 'utterance') {
    fire(player, cue.kind, cue);
  } else if (cue.kind === 'failed' || cue.kind === 'warning') {
    const { code, message, hints = [] } = cue;
    diagnostics.report({ code, severity: cue.kind === 'failed' ? 'error' : 'warning', message, hints });
  }
}

/** Reports a transport event to the mind, the page and screen readers; a finished seek is rendered first. */
export function passTransport(context: PlayerContext, event: TransportEvent): void {
  const { player, say, notify: tell } = context;
  if (event === 'seeking') {
    takeBackSeek(player);
    dispatch(player, 'seeking');
    return;
  }
  if (event === 'play') {
    context.started = true;
    // The feedback on an answer is announced already, and is more relevant.
    if (context.questioner.form.feedback === '') say(wordsFor(player).playing);
  }
  // The question is announced instead, with the feedback on the previous answer.
  if (event === 'pause' && context.questioner.lesson.asked === undefined) say(player.ended ? wordsFor(player).ended : wordsFor(player).paused);
  if (event === 'seeked') {
    const { picture } = context.show ?? {};
    if (context.questioner.isTurning) picture?.seekWithFade(player.currentTime);
    else {
      picture?.seek(player.currentTime);
      context.questioner.sought(player.currentTime);
    }
    context.advance();
  }
  tell({ kind: 'transport', event, timeSecs: player.currentTime });
  if (event === 'seeked' || event === 'pause') dispatch(player, 'timeupdate');
  dispatch(player, event);
  context.keepTime();
  player.requestUpdate();
}
