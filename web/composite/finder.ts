/** View of search results: the matching features, and links to all other matches. */

import { html, nothing, type TemplateResult } from 'lit';
import type { FacePack } from '../element/face/faces.js';
import type { FaceMark } from '../element/base/face-types.js';
import type { App, Tab } from './app.js';
import { indexOf, nearest, search, TABLE, type Index, type Row, type FinderTarget } from './find.js';
import { BEARDS, HAIR, MARKS, WEAR } from './look.js';
import { TABS } from './template.js';

type Attribute = FacePack['attributes'][number];

/** Maximum number of results offered in addition to features. */
const MAX_OFFERS = 8;

const named = (kind: string, names: Readonly<Record<string, string>>): Row[] =>
  Object.entries(names).map(([key, name]) => ({ thing: `${kind} ${key}` as FinderTarget, shown: '', called: [name] }));
const namesOf = (things: Readonly<Record<string, { readonly name: string }>>): Record<string, string> =>
  Object.fromEntries(Object.entries(things).map(([key, { name }]) => [key, name]));

const NAMES = { hair: HAIR, beard: BEARDS, worn: namesOf(WEAR), mark: namesOf(MARKS), tab: TABS } as const;
type Kind = keyof typeof NAMES;
/** Panel, and section of it, of a kind of item. */
const PLACES: Readonly<Record<Exclude<Kind, 'tab'>, readonly [tab: Tab, section?: string]>> = {
  hair: ['look', 'Hair'],
  beard: ['look', 'Beard'],
  worn: ['look', 'Accessories'],
  mark: ['marks'],
};

/** Builds the index of a pack's features and the editor's own items. */
export function finderOf(attributes: readonly Attribute[]): Index {
  return indexOf(attributes, [...TABLE, ...Object.entries(NAMES).flatMap(([kind, names]) => named(kind, names))]);
}

export interface FoundFeature {
  /** The features that are meant, the best first. */
  readonly features: readonly Attribute[];
  /** Links to all other matches. */
  readonly ways: TemplateResult | typeof nothing;
  /** The best is no feature. */
  readonly isElsewhere: boolean;
}

/** Returns the results for the search text. */
export function found(app: App, index: Index, typed: string): FoundFeature {
  const things = search(index, typed).map(({ thing }) => thing);
  const features = things.flatMap((thing) => app.faces.pack.attributes.filter(({ name }) => thing === `feature ${name}`));
  const others = things.filter((thing) => !thing.startsWith('feature '));
  return {
    features,
    ways: things.length === 0 ? proposals(app, index, typed) : waysTo(app, others.slice(0, MAX_OFFERS)),
    isElsewhere: things[0]?.startsWith('feature ') === false,
  };
}

/** Returns buttons that open the panels of items. */
function waysTo(app: App, things: readonly FinderTarget[]): TemplateResult | typeof nothing {
  if (things.length === 0) return nothing;
  return html`<div class="ways" role="group" aria-label="Found elsewhere">${things.map((thing) => {
    const { name, panel, go } = wayTo(app, thing);
    return html`<button type="button" class="plain" @click=${go}><b>${name}</b> <small>${panel}</small></button>`;
  })}</div>`;
}

/** Returns the name of an item, its location, and a function that opens it. */
function wayTo(app: App, thing: FinderTarget): { readonly name: string; readonly panel: string; readonly go: () => void } {
  const [, kind = '', key = ''] = /^(\w+) (.*)$/.exec(thing) ?? [];
  if (kind === 'style') return { name: key, panel: TABS.look, go: () => app.turnTo('look', key) };
  const name = NAMES[kind as Kind]?.[key as never] ?? key;
  if (kind === 'tab') return { name, panel: 'Panel', go: () => app.turnTo(key as Tab) };
  const [tab, section] = PLACES[kind as keyof typeof PLACES];
  const go = (): void => {
    app.turnTo(tab, section);
    if (kind === 'mark') app.placing = key as FaceMark['kind'];
  };
  return { name, panel: section === undefined ? TABS[tab] : `${TABS[tab]}, ${section.toLowerCase()}`, go };
}

/** Returns spelling suggestions for the search text. */
function proposals(app: App, index: Index, typed: string): TemplateResult {
  const take = (word: string) => (): void => {
    app.search = word;
    app.redraw();
  };
  return html`<p class="none">There is no feature of that name. Do you mean one of these?</p>
    <div class="ways" role="group" aria-label="Similar spellings">${nearest(index, typed).map((word) => html`<button type="button" class="plain" @click=${take(word)}>${word}</button>`)}</div>`;
}
