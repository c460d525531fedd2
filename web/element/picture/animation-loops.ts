/** What keeps a player going: a picture whenever the screen takes one, and a slower beat where none is drawn. */

/** `timeupdate`, and everything while the page is hidden, comes this often; media elements do about the same. */
const BEAT_MS = 250;
/** Where a hidden page is watched elsewhere, in a window over others or as a stream, pictures come this often. */
const ELSEWHERE_MS = 40;

/** The loops of one player. */
export class AnimationLoops {
  readonly #picture: () => void;
  readonly #onBeat: () => void;
  #animation = 0;
  #beat: ReturnType<typeof setInterval> | undefined;
  readonly #isElsewhere: () => boolean;
  #elsewhere: ReturnType<typeof setInterval> | undefined;

  /** `picture` is called for each picture of the screen, and with the beat where there are none, more often where `isElsewhere`; `beat` with each beat. */
  constructor(picture: () => void, beat: () => void, isElsewhere: () => boolean) {
    this.#picture = picture;
    this.#onBeat = beat;
    this.#isElsewhere = isElsewhere;
  }

  /** Whether the screen requests pictures. */
  get drawing(): boolean {
    return this.#animation !== 0 && !document.hidden;
  }

  /** Runs the loops that are needed now, and no others. */
  keep(playing: boolean, onScreen: boolean): void {
    if (playing && this.#beat === undefined) {
      this.#beat = setInterval(() => {
        // Without pictures (a hidden page, a player scrolled away) the beat alone carries the story.
        if (!this.drawing) this.#picture();
        this.#onBeat();
      }, BEAT_MS);
    } else if (!playing) {
      clearInterval(this.#beat);
      this.#beat = undefined;
    }
    if (playing && this.#isElsewhere()) this.#elsewhere ??= setInterval(() => this.#beatElsewhere(), ELSEWHERE_MS);
    else this.#restElsewhere();
    if (playing && onScreen && this.#animation === 0) {
      const frame = () => {
        this.#animation = requestAnimationFrame(frame);
        this.#picture();
      };
      this.#animation = requestAnimationFrame(frame);
    } else if (!(playing && onScreen)) {
      cancelAnimationFrame(this.#animation);
      this.#animation = 0;
    }
  }

  #beatElsewhere(): void {
    if (!this.#isElsewhere()) this.#restElsewhere();
    else if (!this.drawing) this.#picture();
  }

  #restElsewhere(): void {
    clearInterval(this.#elsewhere);
    this.#elsewhere = undefined;
  }
}
