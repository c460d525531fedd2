/** Synchronises picture, captions and events with the audible time. */

import { captionAt } from '../captions/captions.js';
import type { PlayerContext } from './context.js';
import { passCue } from './cues.js';
import { dispatch } from '../media/media-events.js';
import { AnimationLoops } from '../picture/animation-loops.js';
import type { Show } from './show.js';
import { IdleClock } from './idle-clock.js';

/** Minimum frame interval while time stands still (the story waits for its voice or sounds, or plays at rate 0), which leaves the CPU to other work. */
const STILL_MS = 1000;

/** Sources that may send more content after the end of the story. */
interface OpenEnd {
  readonly openEnded: boolean;
}

export class FrameLoop {
  readonly #context: PlayerContext;
  readonly #mind: OpenEnd;
  readonly #pulse = new AnimationLoops(
    () => this.advance(),
    () => this.#beat(),
    () => this.#context.isWatchedElsewhere(),
  );
  readonly #welcome = new IdleClock(() => this.advance());
  #caption: ReturnType<typeof captionAt>;
  /** Number of recordings at the last notification of the page. */
  #come = 0;
  /** Current question. */
  #asked: string | undefined;
  /** Last rendered time, and when it was rendered. */
  #drawn = { secs: NaN, ms: 0 };

  constructor(context: PlayerContext, mind: OpenEnd) {
    this.#context = context;
    this.#mind = mind;
  }

  /** Caption of the present speech. */
  get caption(): ReturnType<typeof captionAt> {
    return this.#caption;
  }

  /** Clears the caption after the story was unloaded. */
  clearCaption(): void {
    this.#caption = undefined;
  }

  /** Runs only the loops required by the current state. */
  keep(): void {
    const { player, show, onScreen } = this.#context;
    this.#pulse.keep(show !== undefined && !player.paused, onScreen);
    const { asked } = this.#context.questioner.lesson;
    if (asked?.name !== this.#asked) this.#welcome.restart();
    this.#asked = asked?.name;
    this.#welcome.keep(player.isConnected && onScreen && (this.#waits || (asked !== undefined && player.paused)));
  }

  /** True if the story has not begun and the figure waits. A page with an editor, or with its own view, shows the first frame instead. */
  get #waits(): boolean {
    const { player, show, started, text, view } = this.#context;
    return show !== undefined && player.paused && !started && text === undefined && view === undefined;
  }

  /** Shows the audible time. */
  advance(): void {
    const { player, show } = this.#context;
    if (show === undefined) return;
    const openEnded = this.#mind.openEnded || show.openEnded || show.tellings > 0;
    if (openEnded !== show.transport.openEnded) {
      show.transport.openEnded = openEnded;
      show.picture.setOpenEnded(openEnded);
      dispatch(player, 'durationchange');
    }
    const secs = show.transport.update();
    // If the lesson has jumped elsewhere, that frame is shown already.
    const { questioner, started } = this.#context;
    if (started && !questioner.pass(show, secs, (to) => this.#pass(show, to))) return;
    const ms = performance.now();
    if ((show.transport.waiting || show.transport.rate === 0) && secs === this.#drawn.secs && ms - this.#drawn.ms < STILL_MS) return;
    this.#drawn = { secs, ms };
    const { asked } = questioner.lesson;
    if (this.#waits) show.picture.showIdle(this.#welcome.secs);
    else if (asked !== undefined && player.paused) {
      show.picture.showWaiting(asked.atSecs, this.#welcome.secs, questioner.form.lookedAt);
      void questioner.form.place();
    } else this.#pass(show, secs);
    this.#context.follow();
    this.#context.drawn(secs);
    // A frame may have taken long; captions follow the audio.
    const now = captionAt(show.captions, show.transport.position);
    if (now?.caption !== this.#caption?.caption || now?.word !== this.#caption?.word) {
      this.#caption = now;
      player.requestUpdate();
    }
  }

  /** Shows a time and reports the cues before it. */
  #pass(show: Show, secs: number): void {
    const { player } = this.#context;
    for (const cue of show.picture.show(secs, player.paused && !player.ended, this.#pulse.drawing)) passCue(this.#context, cue, show);
  }

  /** Runs the periodic work, a few times per second, with or without rendering. */
  #beat(): void {
    const { player, show } = this.#context;
    // Frames may be slow; the audio does not wait for them.
    show?.voice.prepare(player.currentTime);
    if (!player.paused) dispatch(player, 'timeupdate');
    if (show !== undefined && show.voice.come !== this.#come) {
      this.#come = show.voice.come;
      dispatch(player, 'progress');
    }
    player.requestUpdate();
  }
}
