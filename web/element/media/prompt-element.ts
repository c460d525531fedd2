/** An element whose updates come when something depends on them. */

import { LitElement } from 'lit';

export abstract class PromptElement extends LitElement {
  /** Listeners may be called in the middle of an update. */
  #updating = false;

  /** A change of an attribute takes effect with the next update; calls that depend on it bring that update about at once. */
  protected settleAttributes(): void {
    if (this.hasUpdated && this.isUpdatePending && !this.#updating) this.performUpdate();
  }

  /** Whoever waits for an update has it also where the element was never in a document: it is played there, too. */
  protected override getUpdateComplete(): Promise<boolean> {
    if (!this.hasUpdated && !this.isConnected) {
      // As with the first connection.
      (this as { renderRoot: HTMLElement | DocumentFragment }).renderRoot ??= this.createRenderRoot();
      this.enableUpdating(true);
    }
    return super.getUpdateComplete();
  }

  protected override performUpdate(): void {
    this.#updating = true;
    super.performUpdate();
    this.#updating = false;
  }
}
