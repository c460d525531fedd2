/** The sound of a show besides its recordings: music, and voices for what has none. */

import { voiceMissing } from './audio.js';
import { fire, libraryOf, type PlayerContext } from './context.js';
import type { Show } from './show.js';
import type { Story } from './types.js';

/** Plays the music of the present performance. */
export function updateMusic({ player }: PlayerContext, { voice, picture }: Show): void {
  voice.setMusic(picture.music(), new URL('music/', libraryOf(player)));
}

const isSilent = ({ script }: Show): boolean => [...script].some(({ audio, words }) => audio.length === 0 && words.length > 0);

/** What tells no language is said in this one. */
function languageOf({ player }: PlayerContext, { story }: Show): string {
  const inherited = player.closest<HTMLElement>('[lang]')?.lang;
  return player.lang || story.performer.language || inherited || navigator.language;
}

/**
 * Has what has no recording spoken, once it is played: by an engine in the page where one speaks the
 * language, else by the browser's own voice. Reports when nobody does. `retell` hears of the story
 * with its new times.
 */
export async function substituteVoice(context: PlayerContext, show: Show, retell: (story: Story) => void): Promise<void> {
  if (!isSilent(show)) return;
  await speakHere(context, show, retell);
  if (context.show !== show || show.lent || show.spoken === undefined || !isSilent(show)) return;
  show.lent = true;
  const { voice } = show.story.performer;
  const name = await show.voice.substitute({ language: languageOf(context, show), voice });
  if (context.show !== show) return;
  context.diagnostics.report(voiceMissing(show.files.bundle !== undefined, name));
}

/** Has the text on stage spoken in the page, once for each text, when it is played or what speaks is there. */
async function speakHere(context: PlayerContext, show: Show, retell: (story: Story) => void): Promise<void> {
  const { player } = context;
  const { eml } = show.files;
  if (show.spoken === eml) return;
  const making = import('../speech/here.js').then(async ({ sourceFor }) => {
    const source = sourceFor(languageOf(context, show));
    if (source === undefined) return undefined;
    if (player.paused && !source.ready) return 'later';
    show.spoken = eml;
    const known = show.files.bundle && new TextDecoder().decode(show.files.bundle);
    const progress = (share: number) => fire(player, 'voiceprogress', { share });
    return await source.speak({ eml, known, voice: source.voiceOf(show.figure) }, { signal: show.end.signal, progress });
  });
  if (!player.paused) show.voice.hold(making);
  try {
    const said = await making;
    if (said === 'later') return;
    show.spoken = eml;
    if (said === undefined || context.show !== show || show.files.eml !== eml) return;
    const bundle = new TextEncoder().encode(said.bundle);
    show.voice.give(said.sounds);
    show.files = { ...show.files, bundle };
    const story = show.picture.voiced(bundle);
    if (story !== undefined) retell(story);
  } catch (error) {
    show.spoken = eml;
    if (show.end.signal.aborted) return;
    console.warn('raconteur: nothing speaks here', error);
  }
}
