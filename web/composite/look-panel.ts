/** Panel of hair, beard, brows, and accessories. */

import { html, nothing, type TemplateResult } from 'lit';
import type { FaceLook, HairColour, HairLook, NaturalHair, AccessoryKind } from '../element/base/face-types.js';
import { numberField, vars } from '../pages/fields.js';
import type { App } from './app.js';
import { hexOf, linearOf } from '../element/base/colour.js';
import { plainLook } from '../element/face/face-look.js';
import { BEARDS, HAIR, mixed, toggled, WEAR } from './look.js';

/** Parts of a look with a hair colour. */
type Part = 'hair' | 'beard' | 'brows';

/** Mixture of a part's colour: two natural colours, the share of the second, and the share of grey. */
interface HairMixture {
  readonly a: string;
  readonly b: string;
  readonly share: number;
  readonly grey: number;
}

const UNMIXED: HairMixture = { a: '', b: '', share: 0, grey: 0 };
/** Grey hair, by the share of hairs without pigment. */
const GREYS = [
  { name: 'grey', grey: 0.6 },
  { name: 'white', grey: 1 },
] as const;
const ends = { 0: 'none', 1: 'all' } as const;
/** Factor by which the lamps brighten hair on a head. */
const LAMPS = 2.2;
const inLight = ([r, g, b]: NaturalHair['rgb']): NaturalHair['rgb'] => [r * LAMPS, g * LAMPS, b * LAMPS];

export class LookPanel {
  readonly #mixtures: Record<Part, HairMixture> = { hair: UNMIXED, beard: UNMIXED, brows: UNMIXED };
  #natural: readonly NaturalHair[] = [];

  constructor(private readonly app: App) {}

  draw(): TemplateResult {
    const { app } = this;
    if (this.#natural.length === 0) this.#natural = app.player.naturalHair();
    const look = plainLook(app.look) ?? {};
    return html`<section class="region" aria-label="Hair"><h3>Hair</h3>
        ${this.#select('Style', HAIR, look.hair?.from ?? 'own', (from, name) => this.#do({ ...look, hair: { ...look.hair, from } }, `hair: ${name}`))} ${this.#colour('hair')}
      </section>
      <section class="region" aria-label="Brows and lashes"><h3>Brows and lashes</h3>${this.#colour('brows')}</section>
      <section class="region" aria-label="Accessories"><h3>Accessories</h3>
        <div class="worn">${(Object.keys(WEAR) as AccessoryKind[]).map((kind) => this.#worn(kind))}</div>
      </section>
      <section class="region" aria-label="Beard"><h3>Beard</h3>
        ${this.#select('Style', BEARDS, look.beard?.from ?? 'own', (from, name) => this.#do({ ...look, beard: { ...look.beard, from } }, `beard: ${name}`))} ${this.#colour('beard')}
      </section>`;
  }

  #do(look: FaceLook, what: string): void {
    this.app.do({ kind: 'look', look, what });
  }

  #select<T extends string>(label: string, options: Readonly<Record<T, string>>, value: T, choose: (value: T, name: string) => void): TemplateResult {
    const take = (event: Event): void => {
      const chosen = (event.target as HTMLSelectElement).value as T;
      choose(chosen, options[chosen].toLowerCase());
    };
    return html`<label class="select side"><span>${label}</span><select @change=${take}>${(Object.entries(options) as [T, string][]).map(
      ([key, name]) => html`<option value=${key} .selected=${key === value}>${name}</option>`,
    )}</select></label>`;
  }

  /** Renders buttons for the natural colours, a second colour to mix in, and grey. */
  #colour(part: Part): TemplateResult {
    const own = colourOf(this.app.look, part);
    const mixture = this.#mixtureOf(part, own);
    const find = (name: string): HairColour | undefined => this.#natural.find((n) => n.name === name)?.colour;
    const put = (next: HairMixture, moves: boolean): void => {
      this.#mixtures[part] = next;
      const a = find(next.a) ?? own ?? find('brown');
      if (a === undefined) return;
      const look = withColour(this.app.look, part, mixed(a, find(next.b) ?? a, next.share, next.grey));
      const what = `${part} ${next.a}${next.share > 0 ? ` with ${next.b}` : ''}${next.grey > 0 ? `, ${Math.round(100 * next.grey)} % grey` : ''}`;
      if (moves) this.app.move({ kind: 'look', look, what });
      else this.#do(look, what);
    };
    const asIs = (): void => this.#do(withColour(this.app.look, part, undefined), `${part}: own colour`);
    const slider = (label: string, key: 'share' | 'grey', text: string): TemplateResult =>
      numberField({
        label,
        value: Math.round(100 * mixture[key]),
        min: 0,
        max: 100,
        step: 1,
        unit: '%',
        text,
        set: (percent) => put({ ...mixture, [key]: percent / 100 }, true),
        done: () => this.app.done(),
      });
    return html`<div class="swatches" role="group" aria-label="Colour of ${part}">
        <button type="button" class="plain" aria-pressed=${own === undefined} @click=${asIs}>As it is</button>
        ${this.#natural.map(
          ({ name, rgb }) =>
            html`<button type="button" class="swatch" aria-label=${name} title=${name} aria-pressed=${mixture.a === name} ${vars({ '--colour': hexOf(inLight(rgb)) })} @click=${() => put({ ...mixture, a: name }, false)}></button>`,
        )}
        ${GREYS.map(
          ({ name, grey }) =>
            html`<button type="button" class="swatch" aria-label=${name} title=${name} aria-pressed=${own !== undefined && mixture.grey === grey} ${vars({ '--colour': hexOf([0.85 * grey, 0.83 * grey, 0.79 * grey]) })} @click=${() => put({ ...mixture, a: mixture.a || 'dark brown', grey }, false)}></button>`,
        )}
      </div>
      ${
        own === undefined
          ? nothing
          : html`${this.#select('With', { '': '—', ...Object.fromEntries(this.#natural.map(({ name }) => [name, name])) }, mixture.b, (b) => put({ ...mixture, b, share: mixture.share || 0.5 }, false))}
          ${mixture.b === '' ? nothing : slider('Share', 'share', `${Math.round(100 * mixture.share)} percent ${mixture.b}`)} ${slider('Grey', 'grey', ends[mixture.grey as 0 | 1] ?? `${Math.round(100 * mixture.grey)} percent`)}`
      }`;
  }

  /** Returns the mixture of a colour, if it is stored or can be derived. */
  #mixtureOf(part: Part, own: HairColour | undefined): HairMixture {
    if (own === undefined) return UNMIXED;
    const plain = this.#natural.find(({ colour }) => colour.eumelanin === own.eumelanin && colour.pheomelanin === own.pheomelanin);
    return plain === undefined ? { ...this.#mixtures[part], grey: own.grey } : { a: plain.name, b: '', share: 0, grey: own.grey };
  }

  #worn(kind: AccessoryKind): TemplateResult {
    const { look } = this.app;
    const { name } = WEAR[kind];
    const worn = look.wear?.find((w) => w.kind === kind);
    const recolour = (event: Event): void => {
      const colour = linearOf((event.target as HTMLInputElement).value);
      const wear = (look.wear ?? []).map((w) => (w.kind === kind ? { kind, colour } : w));
      this.#do({ ...look, wear }, `${name.toLowerCase()}: another colour`);
    };
    return html`<div class="item"><button type="button" class="plain" aria-pressed=${worn !== undefined} @click=${() => this.#do(toggled(look, kind), worn === undefined ? name.toLowerCase() : `no ${name.toLowerCase()}`)}>${name}</button>
      ${worn === undefined ? nothing : html`<input type="color" aria-label="Colour of ${name.toLowerCase()}" .value=${hexOf(worn.colour)} @change=${recolour} />`}</div>`;
  }
}

function colourOf(look: FaceLook, part: Part): HairColour | undefined {
  return part === 'brows' ? look.brows : look[part]?.colour;
}

function withColour(look: FaceLook, part: Part, colour: HairColour | undefined): FaceLook {
  return part === 'brows' ? { ...look, brows: colour } : { ...look, [part]: { ...look[part], colour } satisfies HairLook };
}
