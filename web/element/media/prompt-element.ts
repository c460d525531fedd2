/** Element that updates synchronously on demand. */

import { LitElement } from 'lit';

export abstract class PromptElement extends LitElement {
  /** Listeners may be called in the middle of an update. */
  #updating = false;

  /** Applies pending attribute changes immediately, for calls that depend on them; otherwise they take effect with the next update. */
  protected settleAttributes(): void {
    if (this.hasUpdated && this.isUpdatePending && !this.#updating) this.performUpdate();
  }

  /** Completes pending updates even if the element was never in a document, because it can play there too. */
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
