/** Report of a face: a description and all of its data. */

import type { FacePart, Faces } from '../element/face/faces.js';
import { label, signed, where } from './acts.js';
import type { App } from './app.js';
import { lookFacts } from './look-words.js';
import { PARTS, termOf } from './panels.js';
import { AGES, ANCESTRIES, SEXES } from './people.js';

/** A value that is nearer to the average is written as 0.00. */
const MIN_VALUE = 0.005;

/** Content of a report, in order. */
export interface Report {
  /** Name of the face. */
  readonly name: string;
  readonly date: Date;
  /** Names and values of facts. */
  readonly facts: readonly (readonly [name: string, text: string])[];
  readonly groups: readonly { readonly title: string; readonly rows: readonly { readonly name: string; readonly term: string; readonly value: string }[] }[];
  readonly held: readonly string[];
  /** Steps on the path to the face, each with its number in the history. */
  readonly steps: readonly { readonly step: number; readonly text: string }[];
}

/** Sources of a report. */
export type ReportInput = Pick<App, 'history' | 'values' | 'held' | 'person' | 'look' | 'marks' | 'light'> & {
  readonly faces: Pick<Faces, 'pack'>;
  readonly player: Pick<App['player'], 'naturalHair'>;
};

/** Returns the report of the displayed face. */
export function reportOf(app: ReportInput, date: Date): Report {
  const { history, faces, held, person } = app;
  const { pack } = faces;
  const path = history.path();
  const regions = path.map((step) => history.steps[step]?.act).flatMap((act) => (act !== undefined && 'region' in act ? [act.region] : []));
  const changed = new Set(regions.flatMap(({ segments = [], half }) => (segments.length > 0 ? segments : [half === undefined ? 'the whole head' : `the ${half} half`])));
  return {
    name: history.steps[history.here]?.name ?? 'Face without a name',
    date,
    facts: [
      ['Step', `${history.here} of ${history.steps.length - 1}`],
      ['Faces were chosen by', [SEXES[person.sex], AGES[person.age].toLowerCase(), person.ancestry === 'any' ? 'any ancestry' : ANCESTRIES[person.ancestry]].join(', ')],
      ['Changed', [...changed].join(', ') || 'no individual part'],
      ...lookFacts(app, app.player.naturalHair()),
      ['Face model', `${pack.faces} faces with ${pack.vertices} points each`],
    ],
    groups: groupsOf(app),
    held: held.map((h) => `${h.name}, ${PARTS[h.part].toLowerCase()}: ${signed(h.value)}${where(h)}`),
    steps: path.map((step) => ({ step, text: words(history.steps[step]) })),
  };
}

/** Attributes that differ from the average, by part and group. */
function groupsOf({ faces, values }: ReportInput): Report['groups'] {
  const groups = new Map<string, Report['groups'][number]['rows'][number][]>();
  for (const part of Object.keys(PARTS) as FacePart[]) {
    for (const a of faces.pack.attributes) {
      const value = values[part].get(a.name) ?? 0;
      if (a.part !== part || Math.abs(value) < MIN_VALUE) continue;
      const title = `${PARTS[part]}, ${a.group}`;
      groups.set(title, [...(groups.get(title) ?? []), { name: a.name, term: termOf(value, a.terms), value: signed(value) }]);
    }
  }
  return [...groups].map(([title, rows]) => ({ title, rows }));
}

function words(step: App['history']['steps'][number] | undefined): string {
  if (step === undefined) return '';
  return step.name === undefined ? label(step.act) : `${label(step.act)} (named “${step.name}”)`;
}
