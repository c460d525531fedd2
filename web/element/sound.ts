/** The sound of a show besides its recordings: music, and voices for what has none. */

import { voiceMissing } from './audio.js';
import { fire, libraryOf, type PlayerContext } from './context.js';
import type { Said, Saying, SpeechRequest, SpeechSource } from '../speech/source.js';
import type { Show } from './show.js';
import type { Story } from './types.js';

/** Plays the music of the present performance. */
export function updateMusic({ player }: PlayerContext, { voice, picture }: Show): void {
  voice.setMusic(picture.music(), new URL('music/', libraryOf(player)));
}

const isSilent = ({ script }: Show): boolean => [...script].some(({ audio, words }) => audio.length === 0 && words.length > 0);

/** The text on stage and who says it. */
const spokenBy = ({ figure, files: { eml } }: Show): string => `${figure}\n${eml}`;

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
  // Another figure has another voice.
  const isOfAnother = show.spoken !== undefined && show.spoken !== spokenBy(show);
  if (!isSilent(show) && !isOfAnother) return;
  await speakHere(context, show, retell);
  if (context.show !== show || show.lent || show.spoken === undefined || !isSilent(show)) return;
  show.lent = true;
  const { voice } = show.story.performer;
  const name = await show.voice.substitute({ language: languageOf(context, show), voice });
  if (context.show !== show) return;
  context.diagnostics.report(voiceMissing(show.files.bundle !== undefined, name));
}

/** A fragment that says something. */
const SPEAKS = /<([\w.-]+:)?voice-(text|say)\b/;

/** Has what a fragment says spoken, where something in the page speaks its language; it may be performed then. Undefined where nothing is to be spoken here. */
export function speakFragment(context: PlayerContext, show: Show, fragment: string): Promise<void> | undefined {
  if (context.player.speech === 'browser' || !SPEAKS.test(fragment)) return undefined;
  const before = show.speaking;
  const speaking = (async () => {
    await before;
    const source = await sourceOf(context, show);
    if (source === undefined || context.show !== show) return;
    // It joins what is there.
    take(context, show, await source.speak({ eml: fragment, fragment: true, ...asked(show, source, show.files.bundle) }, saying(context, show)));
    if (show.files.bundle !== undefined) show.picture.hear(show.files.bundle);
  })().catch((error: unknown) => {
    if (!show.end.signal.aborted) console.warn('raconteur: nothing speaks here', error);
  });
  show.speaking = speaking;
  return speaking;
}

async function sourceOf(context: PlayerContext, show: Show): Promise<SpeechSource | undefined> {
  if (context.player.speech === 'browser') return undefined;
  return (await import('../speech/here.js')).sourceFor(languageOf(context, show));
}

/** What a source is told besides the text. */
function asked({ figure }: Show, source: SpeechSource, known: Uint8Array | undefined): Pick<SpeechRequest, 'known' | 'voice'> {
  return { known: known && new TextDecoder().decode(known), voice: source.voiceOf(figure) };
}

const saying = ({ player }: PlayerContext, show: Show): Saying => ({ signal: show.end.signal, progress: (share) => fire(player, 'voiceprogress', { share }) });

/** Keeps what was said, and reports what was not. */
function take({ diagnostics }: PlayerContext, show: Show, { bundle, sounds, problems }: Said): void {
  for (const message of problems) diagnostics.report({ code: 'voice-unsaid', severity: 'warning', message, hints: [] });
  show.voice.give(sounds);
  show.files = { ...show.files, bundle: new TextEncoder().encode(bundle) };
}

/** Has the text on stage spoken in the page, once for each text, when it is played or what speaks is there. */
async function speakHere(context: PlayerContext, show: Show, retell: (story: Story) => void): Promise<void> {
  const { player } = context;
  const { eml } = show.files;
  const wanted = spokenBy(show);
  if (show.spoken === wanted) return;
  // One after another, as fragments are.
  const making = Promise.resolve(show.speaking).then(async () => {
    const source = await sourceOf(context, show);
    // Another text may have come meanwhile.
    if (spokenBy(show) !== wanted || (source !== undefined && player.paused && !source.ready)) return 'later';
    show.spoken = wanted;
    return source && (await source.speak({ eml, ...asked(show, source, show.recorded) }, saying(context, show)));
  });
  show.speaking = making.then(
    () => undefined,
    () => undefined,
  );
  if (!player.paused) show.voice.hold(making);
  try {
    const said = await making;
    if (said === undefined || said === 'later' || context.show !== show || spokenBy(show) !== wanted) return;
    // What was spoken before is of another text, or of another figure's voice.
    show.voice.forget();
    take(context, show, said);
    const story = show.files.bundle && show.picture.voiced(show.files.bundle);
    if (story !== undefined) retell(story);
  } catch (error) {
    show.spoken = wanted;
    if (!show.end.signal.aborted) console.warn('raconteur: nothing speaks here', error);
  }
}
