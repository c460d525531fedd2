/** Opening and starting of sessions in an editor. */

import type { App } from './app.js';
import { History } from './history.js';
import type { Sessions } from './kept-panel.js';
import type { OpenedSession, Session } from './session.js';
import { reason, type EditorFeedback } from './editor-feedback.js';

/** Starts with a session, or without one if it cannot be read. Returns false in that case. */
export function reopen(app: App, saved: unknown, tell: EditorFeedback): boolean {
  if (saved === undefined) return false;
  try {
    app.open(saved);
    return true;
  } catch (error) {
    tell.trouble(`The last session could not be opened: ${reason(error)}`);
    return false;
  }
}

export class SessionKeeper implements Sessions {
  /** Creates the keeper; `told` is called when another session is open. */
  constructor(
    private readonly app: App,
    readonly session: Session,
    private readonly tell: EditorFeedback,
    private readonly told: () => void,
  ) {}

  /** Starts with the stored session; unreadable data remain stored unchanged. */
  goOn({ saved, isCopy }: OpenedSession): void {
    if (!reopen(this.app, saved, this.tell)) void this.session.begin();
    else if (isCopy) this.tell.trouble('Another tab has this session open: this is a copy of it. Both are in the tab History, under Stored sessions.');
    else this.session.adopt(this.app.save());
  }

  /** Opens a stored session; the previous one remains stored. */
  async open(id: string): Promise<void> {
    const { app, session, tell } = this;
    try {
      const saved = await session.read(id);
      if (saved === undefined) throw new Error('It no longer exists.');
      session.settle();
      app.open(saved);
      const isOwn = await session.goOn(id, undefined);
      if (isOwn) session.adopt(app.save());
      this.told();
      if (!isOwn) tell.trouble('Another tab has this session open: this is a copy of it.');
      await app.shownAsItIs;
    } catch (error) {
      tell.trouble(`The session could not be opened: ${reason(error)}`);
    }
  }

  /** Leaves the stored session, and begins another. */
  async begin(): Promise<void> {
    const { app, session } = this;
    session.settle();
    const begun = session.begin();
    app.open(new History().save(app.size));
    this.told();
    await begun;
  }
}
