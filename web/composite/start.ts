/** Starting points of a face: the average, a random face, or the faces of the database, whole or for the selection. */

import { html, nothing, type TemplateResult } from 'lit';
import { choice } from '../pages/fields.js';
import type { App } from './app.js';
import { PARTS } from './panels.js';
import { AGES, ANCESTRIES, chosen, describe, figureOf, FIGURES, SEXES, type Person } from './people.js';
import type { Portraits } from './portraits.js';

/** Parts of a face to take over. */
const TAKEN = { both: 'Shape and colour', ...PARTS } as const;
/** Number of database faces shown at a time. */
const SHOWN = 12;

export function start(app: App, portraits: Portraits): TemplateResult {
  const { people } = app.faces.pack;
  const like = chosen(people, app.person);
  const shown = like.slice(app.first, app.first + SHOWN);
  portraits.want(shown, app.held);
  const set = <K extends keyof Person>(key: K, value: Person[K]): void => {
    app.person[key] = value;
    app.first = 0;
    app.redraw();
  };
  const leaf = (by: number): void => {
    app.first = Math.max(0, Math.min(app.first + by, like.length - 1));
    app.redraw();
  };
  const whole = app.segments.size === 0 && app.half === undefined;
  // Body and clothes match the person; the user's own file stays.
  const dress = (index: number | undefined): void => {
    const person = people[index ?? -1];
    if (person !== undefined && FIGURES.has(app.player.figure ?? '')) app.player.figure = figureOf(person);
  };
  const chance = (): void => {
    const seed = Math.floor(Math.random() * 2 ** 32);
    dress(app.faces.randomPerson(seed));
    app.do({ kind: 'random', seed });
  };
  const take = (index: number): void => {
    if (whole && app.taken === 'both') {
      dress(index);
      app.do({ kind: 'example', index });
    } else app.do({ kind: 'import', index, part: app.taken, region: app.region });
  };
  const of = app.taken === 'both' ? '' : `the ${TAKEN[app.taken].toLowerCase()} of `;
  return html`<div class="row bar">
      <div class="group" role="group" aria-label="Begin with">
        <button type="button" class="plain" @click=${() => app.do({ kind: 'average' })}>Average face</button>
        <button type="button" class="plain" @click=${chance}>Random</button>
      </div>
    </div>
    <div class="whom">
      ${choice('sex', 'Who', app.person.sex, SEXES, (sex) => set('sex', sex))} ${choice('age', 'Age', app.person.age, AGES, (age) => set('age', age))}
      ${choice('ancestry', 'From', app.person.ancestry, ANCESTRIES, (ancestry) => set('ancestry', ancestry))}
      ${choice('taken', 'Take', app.taken, TAKEN, (taken) => {
        app.taken = taken;
        app.redraw();
      })}
    </div>
    <p class="about">${like.length} of ${people.length} faces. ${whole && app.taken === 'both' ? 'Click a face to start with it.' : `Click a face to take over ${of}${[...app.segments].join(', ') || 'the face'}${app.half === undefined ? '' : `, ${app.half} half`}.`}</p>
    <ul class="sheet">
      ${shown.map((index) => {
        const person = people[index];
        const words = person === undefined ? `Face ${index + 1}` : describe(person);
        const picture = portraits.portraitOf(index);
        return html`<li><button type="button" class="plain" @click=${() => take(index)}>
          ${picture === undefined ? html`<span class="blank" aria-hidden="true"></span>` : html`<img src=${picture} width="120" height="150" alt="" />`}<span>${words}</span></button></li>`;
      })}
    </ul>
    ${portraits.busy ? html`<p class="busy"><progress aria-label="Rendering faces" max=${shown.length} .value=${portraits.done(shown)}></progress>Rendering faces</p>` : nothing}
    <div class="group" role="group" aria-label="More faces">
      <button type="button" class="plain" ?disabled=${app.first === 0} @click=${() => leaf(-SHOWN)}>Previous</button>
      <button type="button" class="plain" ?disabled=${app.first + SHOWN >= like.length} @click=${() => leaf(SHOWN)}>Next</button>
    </div>`;
}
