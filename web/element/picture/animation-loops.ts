/** Timers of a player: a callback for each screen frame, and a slower one without rendering. */

/** Interval of `timeupdate`, and of all updates while the page is hidden; media elements use about the same. */
const BEAT_MS = 250;
/** Frame interval on a hidden page whose picture is visible elsewhere, in a picture-in-picture window or a stream. */
const ELSEWHERE_MS = 40;

/** The loops of one player. */
export class AnimationLoops {
  readonly #picture: () => void;
  readonly #onBeat: () => void;
  #animation = 0;
  #beat: ReturnType<typeof setInterval> | undefined;
  readonly #isElsewhere: () => boolean;
  #elsewhere: ReturnType<typeof setInterval> | undefined;

  /** Creates the timers; `picture` is called for each screen frame, and with the beat if there are none, more often if `isElsewhere`; `beat` with each beat. */
  constructor(picture: () => void, beat: () => void, isElsewhere: () => boolean) {
    this.#picture = picture;
    this.#onBeat = beat;
    this.#isElsewhere = isElsewhere;
  }

  /** True if the screen requests frames. */
  get drawing(): boolean {
    return this.#animation !== 0 && !document.hidden;
  }

  /** Runs only the loops required by the current state. */
  keep(playing: boolean, onScreen: boolean): void {
    if (playing && this.#beat === undefined) {
      this.#beat = setInterval(() => {
        // Without frames (a hidden page, a player scrolled away) the timer alone advances the
        // story.
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
