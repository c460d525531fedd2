/** Voice of the visitor's text: the engine for a language, its description, and a better voice, if there is one. */

import type { RaconteurPlayer } from '../../element/index.js';
import { addSpeechSource } from '../../speech/added.js';
import { naturalVoice } from '../../speech/natural.js';
import type { SpeechSource } from '../../speech/source.js';

/** Folder in which `npm run voice` stores the natural voice. */
const KOKORO = 'assets/voices/kokoro/';
/** Download size of the natural voice, MB. */
const KOKORO_MB = 92;

/** Elements of the page for voice information. */
export interface VoiceElements {
  /** Current voice, and the progress of its download. */
  readonly note: Element;
  /** Better voice available: shown once, after the first text. */
  readonly better: HTMLElement;
}

export class Voices {
  readonly #player: RaconteurPlayer;
  readonly #places: VoiceElements;
  /** Description of the current voice, in a sentence. */
  #speaks = '';
  #looked = false;
  #natural: SpeechSource | undefined;
  #isNatural = false;

  constructor(player: RaconteurPlayer, places: VoiceElements) {
    this.#player = player;
    this.#places = places;
    player.addEventListener('voicechange', ({ detail }) => {
      const { name, about, license } = detail;
      places.note.textContent = this.#speaks = `${name} speaks (${license}). ${about}`;
      if (name === 'flite') void this.#lookForBetter();
    });
    player.addEventListener('voiceprogress', ({ detail }) => {
      const { share } = detail;
      places.note.textContent = share < 1 ? `Fetching a voice, once: ${Math.round(100 * share)} %` : this.#speaks;
    });
    places.better.querySelector('button')?.addEventListener('click', () => void this.#use());
  }

  /** Returns true if the voice of a language is slow. */
  isSlow(language: string): boolean {
    return this.#isNatural && language === 'en';
  }

  /** Announces the voice for a language, before anything is fetched. */
  choose(language: string): void {
    this.#places.note.textContent =
      language === 'en' ? '' : 'espeak-ng will speak. It is a separate program under the GPL, version 3 or later, and is fetched once, with the first words.';
  }

  /** Fetches the engine for a language if the page's own voice does not speak it. */
  async bring(language: string): Promise<void> {
    if (language === 'en') return;
    const { espeak } = await import('@raconteur/voice-espeak');
    addSpeechSource(espeak);
  }

  /** Announces, once, that the natural voice is available, or that the page's owner can add it. */
  async #lookForBetter(): Promise<void> {
    if (this.#looked) return;
    this.#looked = true;
    this.#natural = await naturalVoice(new URL(KOKORO, document.baseURI));
    const { better } = this.#places;
    better.hidden = false;
    for (const part of better.querySelectorAll<HTMLElement>('[data-there]')) part.hidden = (part.dataset['there'] === 'true') !== (this.#natural !== undefined);
  }

  /** Fetches the natural voice and uses it from then on. */
  async #use(): Promise<void> {
    const natural = this.#natural;
    if (natural === undefined) return;
    const { better, note } = this.#places;
    better.hidden = true;
    const progress = (share: number) => (note.textContent = `${natural.name} is being fetched, once: ${Math.round(share * KOKORO_MB)} of ${KOKORO_MB} MB`);
    try {
      // Without text, only the voice is prepared.
      const figure = this.#player.currentFigure ?? '';
      await natural.speak({ eml: '<eml><body/></eml>', voice: natural.voiceOf(figure, 'en') }, { signal: new AbortController().signal, progress, take: () => undefined });
      addSpeechSource(natural);
      this.#isNatural = true;
      note.textContent = `${natural.name} speaks from now on. ${natural.about}`;
    } catch (error) {
      note.textContent = `${natural.name} cannot speak here: ${error instanceof Error ? error.message : String(error)}`;
    }
  }
}
