/** Who says the visitor's words: what speaks a language, what it is, and what better voice there is. */

import type { RaconteurPlayer } from '../../element/index.js';
import { addSpeechSource } from '../../speech/added.js';
import { naturalVoice } from '../../speech/natural.js';
import type { SpeechSource } from '../../speech/source.js';

/** Where `npm run voice` puts the natural voice. */
const KOKORO = 'assets/voices/kokoro/';
/** What it takes. */
const KOKORO_MB = 92;

/** Where the page tells of voices. */
export interface VoiceElements {
  /** Who speaks, and how much of that is fetched. */
  readonly note: Element;
  /** What better voice there is: said once, after the first text. */
  readonly better: HTMLElement;
}

export class Voices {
  readonly #player: RaconteurPlayer;
  readonly #places: VoiceElements;
  /** Who speaks, in a sentence. */
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

  /** Whether a language is said by a voice that takes long. */
  isSlow(language: string): boolean {
    return this.#isNatural && language === 'en';
  }

  /** Says what will speak a language, before anything is fetched. */
  choose(language: string): void {
    this.#places.note.textContent =
      language === 'en' ? '' : 'espeak-ng will speak. It is a separate program under the GPL, version 3 or later, and is fetched once, with the first words.';
  }

  /** Brings what speaks a language, where the page's own voice does not. */
  async bring(language: string): Promise<void> {
    if (language === 'en') return;
    const { espeak } = await import('@raconteur/voice-espeak');
    addSpeechSource(espeak);
  }

  /** Tells, once, of the natural voice: that it may be used, or that the page's owner can add it. */
  async #lookForBetter(): Promise<void> {
    if (this.#looked) return;
    this.#looked = true;
    this.#natural = await naturalVoice(new URL(KOKORO, document.baseURI));
    const { better } = this.#places;
    better.hidden = false;
    for (const part of better.querySelectorAll<HTMLElement>('[data-there]')) part.hidden = (part.dataset['there'] === 'true') !== (this.#natural !== undefined);
  }

  /** Fetches the natural voice and has it speak from now on. */
  async #use(): Promise<void> {
    const natural = this.#natural;
    if (natural === undefined) return;
    const { better, note } = this.#places;
    better.hidden = true;
    const progress = (share: number) => (note.textContent = `${natural.name} is being fetched, once: ${Math.round(share * KOKORO_MB)} of ${KOKORO_MB} MB`);
    try {
      // A text without a word: what speaks is made ready.
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
