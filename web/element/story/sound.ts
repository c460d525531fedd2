/** Audio of a show in addition to its recordings: music, and voices for speech without a recording. */

import { voiceMissing } from '../sound/voice.js';
import { fire, languageOf, libraryOf, type PlayerContext } from './context.js';
import type { SpokenAudio, SpeechRequest, SpeechSource } from '../../speech/source.js';
import type { Show, Narration } from './show.js';
import type { Diagnostic, Story } from '../base/types.js';

/** Plays the music of the present performance. */
export function updateMusic({ player }: PlayerContext, { voice, picture }: Show): void {
  voice.setMusic(picture.music(), new URL('music/', libraryOf(player)));
}

const isSilent = ({ script }: Show): boolean => [...script].some(({ audio, words }) => audio.length === 0 && words.length > 0);

/** Returns a key of the text on stage and its speaker. */
const spokenBy = ({ figure, files: { eml } }: Show): string => `${figure}\n${eml}`;

/**
 * Starts speech for utterances without a recording at the first playback: by an engine in the page if one supports the language, otherwise by the browser.
 * Reports if neither does. `retell` receives the story with its new times.
 */
export async function substituteVoice(context: PlayerContext, show: Show, retell: (story: Story) => void): Promise<void> {
  // Another figure has another voice.
  const isOfAnother = show.telling !== undefined && show.telling.of !== spokenBy(show);
  if (!isSilent(show) && !isOfAnother) return;
  await speakHere(context, show, retell);
  if (context.show !== show || show.telling?.isOver !== true || show.telling.of !== spokenBy(show) || !isSilent(show)) return;
  const isFirst = show.lent === undefined;
  const { voice } = show.story.performer;
  show.lent ??= { name: show.voice.substitute({ language: languageOf(context.player, show.story), voice }) };
  const name = await show.lent.name;
  if (context.show !== show) return;
  if (name === undefined) show.unheard = true;
  context.player.requestUpdate();
  if (isFirst) context.diagnostics.report(voiceMissing(show.files.bundle !== undefined, name));
}

/** Pattern of a fragment with speech. */
const SPEAKS = /<([\w.-]+:)?voice-(text|say)\b/;

/**
 * Synthesises the speech of a fragment, if an engine in the page supports its language; it may be performed afterwards. Undefined if there is nothing to
 * synthesise.
 */
export function speakFragment(context: PlayerContext, show: Show, fragment: string): Promise<void> | undefined {
  if (context.player.speech === 'browser' || !SPEAKS.test(fragment)) return undefined;
  const before = show.speaking;
  const { signal } = show.turn;
  const speaking = (async () => {
    await before;
    if (signal.aborted) return;
    const source = await sourceOf(context, show);
    if (source === undefined || context.show !== show) return;
    const saying = { signal: show.end.signal, progress: progressOf(context), take: (said: SpokenAudio) => keep(context, show, said) };
    // The speech joins the existing bundle.
    await source.speak({ eml: fragment, fragment: true, ...asked(context, show, source, show.files.bundle) }, saying);
    if (show.files.bundle !== undefined) show.picture.updateBundle(show.files.bundle);
  })().catch((error: unknown) => {
    if (!show.end.signal.aborted) console.warn('raconteur: nothing speaks here', error);
  });
  show.speaking = speaking;
  return speaking;
}

async function sourceOf(context: PlayerContext, show: Show): Promise<SpeechSource | undefined> {
  if (context.player.speech === 'browser') return undefined;
  const { diagnostics, player } = context;
  // Each fragment looks for the problem.
  const report = (problem: Diagnostic) => {
    if (context.show === show && diagnostics.list.every(({ code }) => code !== problem.code)) diagnostics.report(problem);
  };
  return await (await import('../../speech/here.js')).sourceFor(languageOf(player, show.story), { library: libraryOf(player), report });
}

/** Returns the parameters of a synthesis in addition to the text. */
function asked(context: PlayerContext, show: Show, source: SpeechSource, known: Uint8Array | undefined): Pick<SpeechRequest, 'known' | 'voice'> {
  return { known: known && new TextDecoder().decode(known), voice: source.voiceOf(show.figure, languageOf(context.player, show.story)) };
}

const progressOf =
  ({ player }: PlayerContext) =>
  (share: number): void => {
    fire(player, 'voiceprogress', { share });
  };

/** Stores the synthesised speech, and reports failures. */
function keep({ diagnostics }: PlayerContext, show: Show, { bundle, sounds, problems }: SpokenAudio): void {
  for (const message of problems) diagnostics.report({ code: 'voice-unsaid', severity: 'warning', message, hints: [] });
  show.voice.give(sounds);
  show.files = { ...show.files, bundle: new TextEncoder().encode(bundle) };
}

/** Synthesises the text on stage in the page, once per text, when it is played or the engine is available. */
async function speakHere(context: PlayerContext, show: Show, retell: (story: Story) => void): Promise<void> {
  const { player } = context;
  const of = spokenBy(show);
  if (show.telling?.of === of) {
    // It may have been paused when that began.
    if (!show.telling.isOver && !player.paused && show.speaking !== undefined) show.voice.hold(show.speaking);
    return;
  }
  // A text that has left the stage is no longer awaited.
  show.telling?.end.abort();
  const telling: Narration = { of, end: new AbortController(), isOver: false };
  // The previous text was not spoken; the voice of this text is not known yet.
  if (show.telling !== undefined) show.unheard = false;
  show.telling = telling;
  const before = show.speaking;
  const speaking = (async () => {
    // One after another, as fragments are.
    await before;
    const source = await sourceOf(context, show);
    const isWanted = () => context.show === show && show.telling === telling && spokenBy(show) === of;
    if (!isWanted()) return;
    if (source !== undefined && player.paused && !source.ready) {
      // Playback requests it again.
      show.telling = undefined;
      return;
    }
    if (source !== undefined) await tell(context, show, source, telling, isWanted, retell);
    telling.isOver = true;
  })().catch((error: unknown) => {
    telling.isOver = true;
    if (!show.end.signal.aborted && !telling.end.signal.aborted) console.warn('raconteur: nothing speaks here', error);
  });
  show.speaking = speaking;
  if (!player.paused) show.voice.hold(speaking);
  await speaking;
}

/** Synthesises the text on stage with a source; each part is audible as soon as it is available. */
async function tell(context: PlayerContext, show: Show, source: SpeechSource, { end }: Narration, isWanted: () => boolean, retell: (story: Story) => void): Promise<void> {
  let isFirst = true;
  const take = (said: SpokenAudio) => {
    if (!isWanted()) return;
    // Earlier speech belongs to another text, or to the voice of another figure.
    if (isFirst) show.voice.forget();
    isFirst = false;
    keep(context, show, said);
    const story = show.files.bundle && show.picture.voiced(show.files.bundle);
    if (story !== undefined) retell(story);
  };
  const signal = AbortSignal.any([show.end.signal, end.signal]);
  const { name, about, license } = source;
  fire(context.player, 'voicechange', { name, about, license });
  await source.speak({ eml: show.files.eml, ...asked(context, show, source, show.recorded) }, { signal, progress: progressOf(context), take });
}
