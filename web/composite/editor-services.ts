/** All panels of the editor, for one face. */

import type { TemplateResult } from 'lit';
import type { App, Tab } from './app.js';
import { finderOf } from './finder.js';
import { HistoryPanel } from './history-panel.js';
import { KeptPanel, type Sessions } from './kept-panel.js';
import { LookPanel } from './look-panel.js';
import { marks } from './marks-panel.js';
import { features, heldList } from './panels.js';
import { parts } from './parts-panel.js';
import { Pictures } from './pictures-panel.js';
import { Portraits } from './portraits.js';
import { SegmentPictures } from './segment-pictures.js';
import { start } from './start.js';
import type { EditorFeedback } from './editor-feedback.js';
import { Thumbnails } from './thumbnails.js';

export class EditorServices {
  readonly #portraits: Portraits;
  readonly #thumbnails: Thumbnails;
  readonly #panels: Readonly<Record<Tab, () => TemplateResult>>;

  /** Creates the desk; `place` receives the invisible players for images, `sessions` are those stored by the browser, if available. */
  constructor(app: App, place: HTMLElement, tell: EditorFeedback, sessions?: Sessions) {
    const portraits = (this.#portraits = new Portraits(app, place));
    const thumbnails = (this.#thumbnails = new Thumbnails(app, (picture) => {
      sessions?.session.pictured(picture, () => app.save());
      app.redraw();
    }));
    const looks = new LookPanel(app);
    const past = new HistoryPanel(app, thumbnails, sessions && new KeptPanel(app, sessions));
    const pictures = new Pictures(app, place, tell);
    const index = finderOf(app.faces.pack.attributes);
    const segments = new SegmentPictures(app.faces);
    this.#panels = {
      start: () => start(app, portraits),
      features: () => features(app, index),
      parts: () => parts(app, segments),
      look: () => looks.draw(),
      marks: () => marks(app),
      held: () => heldList(app),
      history: () => past.draw(),
      pictures: () => pictures.draw(),
    };
  }

  draw(tab: Tab): TemplateResult {
    if (tab !== 'start') this.#portraits.rest();
    return this.#panels[tab]();
  }

  /** Reports to the panels that the stage shows a face. */
  shown(): void {
    this.#thumbnails.shown();
  }

  /** True while other images are being rendered. */
  get busy(): boolean {
    return this.#portraits.busy;
  }

  /** Releases resources that a page without need for the editor does not have to hold. */
  release(): void {
    this.#portraits.release();
  }
}
