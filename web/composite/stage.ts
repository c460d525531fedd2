/** The face on stage: motionless while it is edited, viewed from all sides, or speaking a sentence. */

import { html, nothing, type TemplateResult } from 'lit';
import type { RaconteurPlayer } from '../element/element.js';
import type { Light } from '../element/base/types.js';
import { lookFrom } from '../pages/head-view.js';
import type { App } from './app.js';
import { LIGHTS } from './scene.js';
import { REST_SECS, saying, still } from './script.js';
import { reason, type EditorFeedback } from './editor-feedback.js';

/** Maximum length of the text, characters: about one sentence. */
const MAX_LETTERS = 300;

/** Makes the face look ahead without motion. */
export async function rest(player: RaconteurPlayer): Promise<void> {
  player.pause();
  // A face that is compared with a memory does not sway.
  await player.rehearse(still, { motion: 0 });
  player.currentTime = REST_SECS;
}

/** Turn of the lamps per press, radians. */
const LIGHT_TURN = Math.PI / 6;

/** Returns the controls for the viewing side, the eye height of the person who saw the face, and the direction of the light. */
export function views(app: App): TemplateResult {
  const { view, light } = app;
  const turn = (by: number): void => app.relight({ ...light, turn: light.turn + by });
  const tilt = (by: number): void => view.look({ tilt: view.from.tilt + by });
  return html`${lookFrom(view)}
    <div class="group" role="group" aria-label="Height of the witness">
      <button type="button" class="plain" aria-label="From lower" @click=${() => tilt(-0.1)}>↓</button>
      <button type="button" class="plain" aria-label="From higher" @click=${() => tilt(0.1)}>↑</button>
    </div>
    <div class="group" role="group" aria-label="Light">
      <label class="select side"><span>Light</span><select @change=${(event: Event) => app.relight({ ...light, name: (event.target as HTMLSelectElement).value as Light })}>
        ${(Object.entries(LIGHTS) as [Light, string][]).map(([name, text]) => html`<option value=${name} .selected=${name === light.name}>${text}</option>`)}</select></label>
      <button type="button" class="plain" aria-label="Light more from the left" @click=${() => turn(-LIGHT_TURN)}>↶</button>
      <button type="button" class="plain" aria-label="Light more from the right" @click=${() => turn(LIGHT_TURN)}>↷</button>
    </div>`;
}

/** Makes the face speak. */
export function speaking(player: RaconteurPlayer, tell: EditorFeedback): TemplateResult {
  const speak = async (event: Event): Promise<void> => {
    event.preventDefault();
    const text = (event.currentTarget as HTMLFormElement).querySelector('input')?.value.trim().slice(0, MAX_LETTERS) ?? '';
    if (text === '') return;
    try {
      await player.rehearse(saying(text));
      player.currentTime = 0;
      await player.play();
    } catch (error) {
      tell.trouble(`It cannot speak now: ${reason(error)}`);
    }
  };
  return html`<form class="line" @submit=${speak}>
    <label class="select"><span>Let this face speak</span><input type="text" name="line" maxlength=${MAX_LETTERS} value="Hello! It is good to see you." autocomplete="off" /></label>
    <button type="submit" class="play">Speak</button>
    ${player.paused ? nothing : html`<button type="button" class="plain" @click=${() => void rest(player)}>Stop</button>`}
  </form>`;
}
