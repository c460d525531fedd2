/** Connection of a player to the mind named in its attribute; keeps the performance open for it. */

import { fire, type PlayerContext } from '../story/context.js';
import { dropped, interrupts, perform, Sender } from '../story/fragments.js';
import type { MindEvent } from '../base/mind-events.js';
import type { MindLink } from './mind.js';
import type { Show } from '../story/show.js';

export class MindConnection {
  readonly #context: PlayerContext;
  #link: MindLink | undefined;
  /** True while the connection code of a named mind is being fetched: an empty story does not end meanwhile. */
  #awaited = false;

  constructor(context: PlayerContext) {
    this.#context = context;
  }

  /** True if the clock may pass the end of the story, because more content may arrive. */
  get openEnded(): boolean {
    return this.#link?.listening ?? this.#awaited;
  }

  send(event: MindEvent): void {
    this.#link?.send(event);
  }

  /** Connects to the mind that the attribute names, and closes the connection before. */
  async connect(show: Show): Promise<void> {
    const { player, diagnostics } = this.#context;
    this.#link?.close();
    this.#link = undefined;
    const address = player.mind;
    this.#awaited = Boolean(address);
    if (!address) return;
    try {
      const { MindLink } = await import('./mind.js');
      if (this.#context.show !== show || player.mind !== address || this.#link !== undefined) return;
      this.#link = MindLink.open(address, {
        hello: () => ({ timeSecs: player.currentTime, endSecs: show.transport.endSecs, figure: show.figure }),
        perform: (fragment) => perform(this.#context, show, Sender.Mind, fragment),
        interrupts,
        turn: () => show.turn.signal,
        dropped: () => dropped(player.currentTime),
        report: (diagnostic) => diagnostics.report(diagnostic),
        state: (state) => {
          this.#context.advance();
          fire(player, 'mindchange', { state });
        },
      });
    } catch {
      diagnostics.report({ code: 'mind-lost', severity: 'warning', message: 'The module for minds could not be fetched.', hints: [] });
    }
    this.#awaited = false;
  }

  close(): void {
    this.#link?.close();
    this.#link = undefined;
    this.#awaited = false;
  }
}
