/** Template of the whole editor, from its state. */

import { html, nothing, type TemplateResult } from 'lit';
import type { Tab } from './app.js';
import { teller } from './performer-menu.js';

export const TABS: Readonly<Record<Tab, string>> = {
  start: 'Faces',
  features: 'Features',
  parts: 'Parts',
  look: 'Style',
  marks: 'Marks',
  held: 'Held',
  history: 'History',
  pictures: 'Export',
};
const PAD = 'View: drag or press arrow keys to turn the head, plus and minus to zoom; F, T and P for front, three-quarter and profile';

/** Contents of the template; parts that need a face are absent until there is one. */
export interface Layout {
  readonly tools?: TemplateResult;
  readonly views?: TemplateResult;
  readonly panel?: TemplateResult;
  readonly speaking?: TemplateResult;
  /** True if the next press places something on the skin. */
  readonly placing: boolean;
  /** Share of the faces fetched, while fetching. */
  readonly share: number | undefined;
  /** Error message. */
  readonly trouble: string;
  /** Status text for screen readers. */
  readonly status: string;
}

export function template({ tools, views, panel, speaking, placing, share, trouble, status }: Layout): TemplateResult {
  return html`<div class="viewer composite">
    <div class="bench">
      <div class="head" part="head">
        <slot name="head"></slot>
        <div class="group" part="tools" role="group" aria-label="The whole face">${tools ?? nothing}</div>
      </div>
      <div class="stage" part="stage">
        <div class="frame" part="frame">
          <div id="portraits" class="behind" aria-hidden="true" inert></div>
          <raconteur-player id="player" part="player" label="The face"></raconteur-player>
          <canvas id="fine" class="fine" aria-hidden="true" hidden></canvas>
          <div class=${placing ? 'pad placing' : 'pad'} id="pad" tabindex="0" role="group" aria-label=${PAD}></div>
        </div>
        <div class="transport" part="transport">${views ?? nothing}</div>
        <div class="saying" part="speaking">${speaking ?? nothing}</div>
        <p class="trouble" id="trouble" part="trouble" role="alert">${trouble}</p>
        ${teller}
      </div>
      <div class="controls">
        <div class="tabs" part="tabs" role="tablist" aria-label="Controls">
          ${Object.entries(TABS).map(([tab, name]) => html`<button type="button" role="tab" id="tab-${tab}" data-tab=${tab} aria-controls="panel">${name}</button>`)}
        </div>
        <div class="panel" id="panel" part="panel" role="tabpanel" tabindex="-1">${panel ?? opening(share)}</div>
      </div>
    </div>
    <div class="unseen" role="status" id="status" part="status">${status}</div>
  </div>`;
}

function opening(share: number | undefined): TemplateResult | typeof nothing {
  if (share === undefined) return nothing;
  return html`<p class="busy"><progress aria-label="Fetching the faces" .value=${share}></progress>Fetching the faces…</p>`;
}
