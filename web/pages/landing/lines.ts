/** Lines of the story next to the stage, with the spoken one highlighted. */

import { type Caption, captionAt, captionsOf } from '../../element/captions/captions.js';
import type { PlayerEventMap, RaconteurPlayer } from '../../element/index.js';
import type { FaceCourse } from '../../element/base/face-types.js';
import type { Utterance } from '../../element/base/types.js';
import { corrected, guessed, matches, scriptOf, scriptOfTexts } from './script.js';

/** Media query for the width at which home.css shows the lines. */
const WIDE = '(min-width: 1280px)';
/** Time after the user scrolls the lines during which they do not scroll automatically. */
const READING_MS = 5000;

/** Elements of the page for the lines. */
interface LineElements {
  /** Scrolls. */
  readonly box: HTMLElement;
  readonly list: HTMLElement;
  /** Message if there are no lines. */
  readonly note: HTMLElement;
}

/** A line on the page. */
interface Row {
  readonly button: HTMLButtonElement;
  readonly time: HTMLElement;
  readonly words: readonly HTMLElement[];
}

/** Formats a time as the stage's own controls do. */
const clock = (secs: number): string => `${Math.floor(secs / 60)}:${String(Math.floor(secs % 60)).padStart(2, '0')}`;

export class Lines {
  readonly #player: RaconteurPlayer;
  readonly #places: LineElements;
  readonly #wide = matchMedia(WIDE);
  readonly #calm = matchMedia('(prefers-reduced-motion: reduce)');
  /** Lines of the visitor's own text, while it is on stage. */
  #own: readonly string[] | undefined;
  /** Utterances by the index in events. */
  #script = new Map<number, Utterance>();
  #lines: readonly Caption[] = [];
  #rows: readonly Row[] = [];
  /** The texts of the rows. */
  #drawn = '';
  /** True if the story was played or sought: before that nothing is spoken. */
  #isBegun = false;
  #current = -1;
  #readsUntilMs = 0;

  constructor(player: RaconteurPlayer, places: LineElements) {
    this.#player = player;
    this.#places = places;
    player.addEventListener('emptied', () => this.#clear());
    for (const type of ['loadedmetadata', 'durationchange', 'figurechange']) player.addEventListener(type, () => void this.#read());
    for (const type of ['play', 'seeking']) player.addEventListener(type, () => (this.#isBegun = true));
    for (const type of ['timeupdate', 'seeked', 'ended']) player.addEventListener(type, () => this.#light());
    player.addEventListener('utterance', ({ detail }) => this.#hear(detail));
    player.addEventListener('word', ({ detail }) => this.#hearWord(detail));
    this.#wide.addEventListener('change', () => void this.#read());
    for (const type of ['wheel', 'touchmove']) places.box.addEventListener(type, () => (this.#readsUntilMs = performance.now() + READING_MS), { passive: true });
  }

  /** Sets the visitor's own text, or, without one, the player's story. */
  tell(own: readonly string[] | undefined): void {
    this.#own = own;
    this.#clear();
  }

  #clear(): void {
    this.#isBegun = false;
    this.#readsUntilMs = 0;
    this.#set(new Map());
    this.#places.note.textContent = this.#own === undefined ? '' : 'Your words appear here as they are spoken.';
  }

  /** Reads the utterances of the text on stage, with their times. */
  async #read(): Promise<void> {
    const [own, { src }] = [this.#own, this.#player];
    // Only the mouth shapes are needed, not the curves.
    const course = this.#player.course(0, 0, 1);
    if (!this.#wide.matches || course === undefined) return;
    if (own !== undefined) {
      this.#set(new Map(scriptOfTexts(own, course).entries()));
    } else if (course.names.length === 0) {
      this.#set(new Map());
      this.#places.note.textContent = 'This story has no speech.';
    } else if (src !== '') {
      const script = await this.#fetch(src, course);
      if (script !== undefined && src === this.#player.src && this.#own === undefined) this.#set(new Map(script.entries()));
    }
  }

  /** Fetches the utterances of a story's bundle. Without it the lines appear as they are spoken. */
  async #fetch(src: string, course: FaceCourse): Promise<Utterance[] | undefined> {
    try {
      // The player has fetched it just now, so the browser has it.
      const response = await fetch(new URL('voice/speech.json', new URL(src, document.baseURI)));
      return scriptOf((await response.json()) as Parameters<typeof scriptOf>[0], course);
    } catch {
      return undefined;
    }
  }

  #hear({ phase, utterance, text, startSecs, endSecs }: PlayerEventMap['utterance']['detail']): void {
    const known = this.#script.get(utterance);
    if (phase === 'start' && (known === undefined || !matches(known, text, startSecs))) this.#put(utterance, guessed(text, startSecs, endSecs));
    this.#light();
  }

  #hearWord({ word, utterance, index }: PlayerEventMap['word']['detail']): void {
    const known = this.#script.get(utterance);
    if (known?.estimated) this.#put(utterance, corrected(known, index, word));
    this.#light();
  }

  #put(index: number, utterance: Utterance): void {
    this.#set(new Map(this.#script).set(index, utterance));
  }

  #set(script: Map<number, Utterance>): void {
    this.#script = script;
    // A story has one language; the language of the visitor's own text is not known here.
    this.#places.list.lang = script.get(0)?.language ?? '';
    this.#lines = captionsOf(
      [...script.values()].sort((a, b) => a.startSecs - b.startSecs),
      document.documentElement.lang,
    );
    if (this.#wide.matches) this.#draw();
  }

  /** Rebuilds the rows if the words have changed; if only times change, the keyboard focus is preserved. */
  #draw(): void {
    const drawn = this.#lines.map(textOf).join('\n');
    if (drawn !== this.#drawn) {
      this.#drawn = drawn;
      this.#current = -1;
      this.#rows = this.#lines.map((line, i) => this.#row(line, i));
      this.#places.list.replaceChildren(
        ...this.#rows.map(({ button }) => {
          const item = document.createElement('li');
          item.append(button);
          return item;
        }),
      );
      this.#places.box.scrollTop = 0;
      if (drawn !== '') this.#places.note.textContent = '';
    }
    this.#rows.forEach(({ time }, i) => (time.textContent = clock(this.#lines[i]?.startSecs ?? 0)));
    this.#light();
  }

  #row({ words, second }: Caption, index: number): Row {
    const button = document.createElement('button');
    button.type = 'button';
    button.addEventListener('click', () => this.#seek(index));
    const time = document.createElement('time');
    const text = document.createElement('span');
    const spans = words.map((word) => {
      const span = document.createElement('span');
      span.textContent = word.text;
      return span;
    });
    // A line of verse is a line here too.
    text.append(...spans.flatMap((span, i) => (i === 0 ? [span] : [' ', ...(i === second ? [document.createElement('br')] : []), span])));
    button.append(time, text);
    return { button, time, words: spans };
  }

  #seek(index: number): void {
    const line = this.#lines[index];
    if (line === undefined) return;
    this.#readsUntilMs = 0;
    this.#player.currentTime = line.startSecs;
  }

  /** Highlights the current line and word. A pause belongs to the preceding line. */
  #light(): void {
    if (!this.#wide.matches) return;
    const secs = this.#player.currentTime;
    const ended = this.#player.ended;
    const begun = this.#isBegun ? this.#lines.filter((line) => line.startSecs <= secs).length : 0;
    const current = ended ? -1 : begun - 1;
    const word = current < 0 ? undefined : captionAt(this.#lines, secs);
    this.#rows.forEach(({ button, words }, i) => {
      button.classList.toggle('past', i < begun && i !== current);
      if (i === current) button.setAttribute('aria-current', 'true');
      else button.removeAttribute('aria-current');
      words.forEach((span, k) => span.classList.toggle('said', i === current && k === word?.word));
    });
    if (current !== this.#current) this.#show((this.#current = current));
  }

  /** Scrolls a line into view inside the box, with the preceding one on top; the page does not scroll. */
  #show(index: number): void {
    const above = this.#rows[Math.max(0, index - 1)];
    if (index < 0 || above === undefined || performance.now() < this.#readsUntilMs) return;
    const { box, list } = this.#places;
    const top = above.button.getBoundingClientRect().top - list.getBoundingClientRect().top;
    box.scrollTo({ top, behavior: this.#calm.matches ? 'auto' : 'smooth' });
  }
}

const textOf = ({ words }: Caption): string => words.map((word) => word.text).join(' ');

/** Returns the lines of a player, if the page has an element for them. */
export function lines(player: RaconteurPlayer): Lines | undefined {
  const box = document.querySelector<HTMLElement>('#lines');
  const list = box?.querySelector('ol');
  const note = box?.querySelector('p');
  return box && list && note ? new Lines(player, { box, list, note }) : undefined;
}
