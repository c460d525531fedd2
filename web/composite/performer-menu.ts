/** Choice of the figure that shows the face: the figures of the library, or a user's file; `cast` connects it. */

import { html, type TemplateResult } from 'lit';
import amara from '../pages/portraits/amara.webp';
import kenji from '../pages/portraits/kenji.webp';
import lia from '../pages/portraits/lia.webp';
import nuno from '../pages/portraits/nuno.webp';
import papous from '../pages/portraits/papous.webp';
import sofia from '../pages/portraits/sofia.webp';

const FIGURES = [
  ['sofia', 'Sofia', sofia],
  ['papous', 'Papous', papous],
  ['nuno', 'Nuno', nuno],
  ['amara', 'Amara', amara],
  ['kenji', 'Kenji', kenji],
  ['lia', 'Lia', lia],
] as const;

/** Markup like `teller.html` and `cast.html` of the pages. The emblem is inline, since `use` does not render one from another origin. */
export const teller: TemplateResult = html`<div class="teller" part="teller">
  <h2 id="teller-title">Body, clothes and voice of</h2>
  <div class="cast" role="group" aria-labelledby="teller-title">
    ${FIGURES.map(
      ([figure, name, portrait]) =>
        html`<button type="button" data-figure=${figure} aria-pressed="false"><img src=${portrait} width="52" height="52" alt="" /><span>${name}</span></button>`,
    )}
    <label class="own">
      <input type="file" id="own-figure" accept=".glb,.gltf,.vrm" aria-describedby="own-note" />
      <svg viewBox="0 0 64 64" aria-hidden="true">
        <rect x="1.5" y="1.5" width="61" height="61" rx="17" fill="none" stroke="currentColor" stroke-width="2" stroke-dasharray="5 5" opacity=".55" />
        <circle cx="32" cy="25" r="9" fill="none" stroke="currentColor" stroke-width="2.6" />
        <path d="M15 52c1.5-10 8-15 17-15 5 0 9 1.6 12 4.6M46 44v13M39.5 50.5h13" fill="none" stroke="currentColor" stroke-width="2.6" stroke-linecap="round" />
      </svg>
      <span id="own-name">Yours</span>
    </label>
  </div>
  <p class="cast-note" id="own-note">Use your own .glb, .gltf or .vrm file: choose it, or drop it on the stage. It stays on your machine.</p>
  <p class="cast-trouble" id="cast-trouble" role="status"></p>
  <details class="cast-remarks" id="own-remarks" hidden>
    <summary></summary>
    <ul></ul>
  </details>
</div>`;
