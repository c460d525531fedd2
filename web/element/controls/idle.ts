/** User activity: controls hide after a period without pointer or keyboard input. */

/** The controls hide after this long without a pointer or key, while playing. */
const HIDE_CONTROLS_MS = 2600;

/** Measures the time since the last input. */
export class Idle {
  readonly #busy: () => boolean;
  readonly #changed: () => void;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #tapWoke = false;
  #is = false;

  /** Creates the timer. While `busy` returns true, controls stay; `changed` is called when they appear or disappear. */
  constructor(busy: () => boolean, changed: () => void) {
    this.#busy = busy;
    this.#changed = changed;
  }

  /** True if there was no input for a while. */
  get is(): boolean {
    return this.#is;
  }

  /** Handles input: ends the idle state and restarts its timer. */
  wake(): void {
    clearTimeout(this.#timer);
    this.#set(false);
    this.#timer = setTimeout(() => this.#set(!this.#busy()), HIDE_CONTROLS_MS);
  }

  /** Handles a tap: a finger's first tap on hidden controls only shows them. */
  tap(event: PointerEvent, paused: boolean): void {
    this.#tapWoke = event.pointerType === 'touch' && this.#is && !paused;
  }

  /** True if the last tap only showed the controls. */
  get tapWoke(): boolean {
    return this.#tapWoke;
  }

  #set(is: boolean): void {
    if (is === this.#is) return;
    this.#is = is;
    this.#changed();
  }
}
