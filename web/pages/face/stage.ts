/** Picture of the face page: views of the head, and layers. */

import { html, type TemplateResult } from 'lit';
import { lookFrom } from '../head-view.js';
import type { App } from './app.js';
import type { Layers } from './state.js';

const LAYERS: Readonly<Record<keyof Layers, string>> = { skin: 'Skin', springs: 'Springs', muscles: 'Muscles', skull: 'Skull' };

/** Renders the buttons for views, and for rendering modes. */
export function views(app: App): TemplateResult {
  const { layers } = app.state;
  const turn = (key: keyof Layers): void =>
    app.set((s) => {
      s.layers[key] = !s.layers[key];
      // At least one layer is always visible: hiding the skin shows the muscles, and the other way
      // round.
      if (!Object.values(s.layers).some(Boolean)) s.layers[key === 'skin' ? 'muscles' : 'skin'] = true;
    });
  return html`${lookFrom(app.view)}
    <div class="group" role="group" aria-label="Layers">
      ${(Object.entries(LAYERS) as [keyof Layers, string][]).map(([key, name]) => html`<button type="button" class="plain" aria-pressed=${layers[key]} @click=${() => turn(key)}>${name}</button>`)}
    </div>`;
}
