/** Panel of display options: rendered parts of the figure (GEVH D.3.4). */

import { html, type TemplateResult } from 'lit';
import { check, choice } from '../fields.js';
import type { App } from './app.js';
import { LOOK, type Fill, type Look } from './state.js';

const FILLS: Readonly<Record<Fill, string>> = { solid: 'Solid', wireframe: 'Wireframe', point: 'Points' };

const PRESETS: Readonly<Record<string, Partial<Look>>> = {
  'As on stage': {},
  'X-ray': { fill: 'wireframe', bones: true, centers: true },
  Skeleton: { skin: false, bones: true, frames: true },
  Clay: { materials: false },
  'Point cloud': { fill: 'point' },
};

export function look(app: App): TemplateResult {
  const { look: now } = app.state;
  const set = (change: Partial<Look>): void => app.set((s) => Object.assign(s.look, change));
  const flag = (key: Exclude<keyof Look, 'fill'>, label: string, note?: string): TemplateResult =>
    check(
      label,
      now[key],
      (on) => {
        // A figure is always visible: hiding the skin shows the bones, and the other way round.
        const other = !on && key === 'skin' ? { bones: true } : !on && key === 'bones' ? { skin: true } : {};
        set({ ...other, [key]: on });
      },
      note,
    );
  return html`<div class="choice" role="group" aria-label="Ready-made looks">
      <div>
        ${Object.entries(PRESETS).map(([name, change]) => {
          const whole = { ...LOOK, ...change };
          const on = (Object.keys(whole) as (keyof Look)[]).every((key) => whole[key] === now[key]);
          return html`<button type="button" class="plain" aria-pressed=${on} @click=${() => set(whole)}>${name}</button>`;
        })}
      </div>
    </div>
    ${choice('fill', 'Surface', now.fill, FILLS, (fill) => set({ fill }))}
    <div class="checks">
      ${flag('skin', 'Skin', 'the body with clothes and hair')}
      ${flag('bones', 'Bones', 'the 54 of the skeleton')}
      ${flag('frames', 'Frames', 'axes of every bone: x red, y green, z blue')}
      ${flag('centers', 'Hierarchy centres', 'the joint of every bone')}
      ${flag('manipulators', 'Manipulators', 'where hands and feet are sent')}
      ${flag('materials', 'Materials', 'else as if cast in clay')}
      ${flag('textures', 'Textures', 'pictures on the surfaces')}
    </div>`;
}
