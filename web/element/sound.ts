/** The sound of a show besides its recordings: music, and the browser's own voice. */

import { voiceMissing } from './audio.js';
import { libraryOf, type PlayerContext } from './context.js';
import type { Show } from './show.js';

/** Plays the music of the present performance. */
export function updateMusic({ player }: PlayerContext, { voice, picture }: Show): void {
  voice.setMusic(picture.music(), new URL('music/', libraryOf(player)));
}

/** Has the browser's own voice say what has no recording, once a show, and reports whether there is one. */
export async function substituteVoice(context: PlayerContext, show: Show): Promise<void> {
  const { player } = context;
  if (show.lent || [...show.script].every(({ audio, words }) => audio.length > 0 || words.length === 0)) return;
  show.lent = true;
  const { language, voice } = show.story.performer;
  const inherited = player.closest<HTMLElement>('[lang]')?.lang;
  const name = await show.voice.substitute({ language: player.lang || language || inherited || navigator.language, voice });
  if (context.show !== show) return;
  context.diagnostics.report(voiceMissing(show.files.bundle !== undefined, name));
}
