/** Actions of a player's controls and keys. */

import { CaptionMenu } from './controls/caption-menu.js';
import type { BarActions } from './controls/controls.js';
import type { KeyActions } from './controls/keyboard.js';
import type { RaconteurPlayer } from './element.js';
import { wordsFor, type PlayerContext } from './story/context.js';
import { hasCaptions } from './story/show.js';

/** Returns the actions of a player. */
export function actionsOf(player: RaconteurPlayer, context: PlayerContext): KeyActions & BarActions {
  const { say } = context;
  const isFullscreen = () => document.fullscreenElement === player;
  const actions: KeyActions & BarActions = {
    toggle: () => {
      const { lesson, form } = context.questioner;
      // The story continues after the answer.
      if (player.paused && lesson.asked !== undefined) return form.focus();
      if (player.paused) player.play().catch((error: Error) => error.name !== 'AbortError' && say(wordsFor(player).notStarted));
      else player.pause();
    },
    seekTo: (secs) => (player.currentTime = secs),
    seekBy: (secs) => (player.currentTime += secs),
    seekToShare: (share) => {
      if (Number.isFinite(player.duration)) player.currentTime = player.duration * share;
    },
    setVolume: (volume) => {
      player.volume = volume;
      player.muted = false;
    },
    volumeBy: (step) => actions.setVolume(Math.min(1, Math.max(0, Math.round((player.volume + step) * 20) / 20))),
    setRate: (rate) => (player.playbackRate = rate),
    toggleMuted: () => (player.muted = !player.muted),
    toggleCaptions: () => {
      const on = !hasCaptions(player, context.show);
      if (context.show !== undefined) context.show.refusesCaptions = !on;
      player.captions = on;
      player.requestUpdate();
      const { captionsOn, captionsOff } = wordsFor(player);
      say(on ? captionsOn : captionsOff);
    },
    chooseCaptions: (track) => {
      player.textTracks.select(track);
      say(track === undefined ? wordsFor(player).captionsOff : wordsFor(player).captionsOn);
    },
    captionMenu: new CaptionMenu(player),
    toggleFullscreen: () => {
      const change = isFullscreen() ? document.exitFullscreen() : player.requestFullscreen();
      // A browser may refuse; the player stays as it is.
      change.catch(() => undefined);
    },
    dismiss: () => {
      if (actions.captionMenu.close()) return true;
      const open = player.renderRoot.querySelector('details[open]');
      if (open instanceof HTMLDetailsElement) open.open = false;
      else if (isFullscreen()) actions.toggleFullscreen();
      else return false;
      return true;
    },
  };
  return actions;
}
