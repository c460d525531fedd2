// `node web/tools/people.mjs RACONTEUR`: checks properties of all people that the body model can
// generate, with its data fetched. The library's people match the model's result for their traits,
// a person reaches target measures, and random people determine the muscles that close the lips
// from every vowel.

import { mkdtempSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { ask, main, run, Stop } from './steps.mjs';

const PEOPLE = 'crate/sculpt/src/people';
const STORY = 'tests/bilabials';
/** Number of random people; each takes about four seconds of one processor. */
const CROWD = 40;
/** Maximum deviation of a fit from a wanted measure, standard deviations. */
const NEAR = 0.7;

const [raconteur] = process.argv.slice(2);

/** Checks that the heads of the library match the model's output for their traits. */
function binds(folder) {
  for (const file of readdirSync(PEOPLE).filter((f) => f.endsWith('.json'))) {
    const [made, kept] = [join(folder, 'person.tsv'), join(PEOPLE, file.replace('.json', '.tsv'))];
    run(raconteur, ['figure', 'bind', join(PEOPLE, file), '--output', made], { why: `The head of ${file}` });
    if (readFileSync(made, 'utf8') !== readFileSync(kept, 'utf8')) throw new Stop(`${kept} is not what the model gives for ${file}.`);
  }
}

/** Checks that a person can be fitted to wanted measures. */
function fits(folder) {
  const wanted = { nose_breadth: 1, face_height: -1, mouth_breadth: 0.5, ear_length: -0.5 };
  const [measures, person] = [join(folder, 'measures.json'), join(folder, 'person.json')];
  writeFileSync(measures, JSON.stringify(wanted));
  const told = ask(raconteur, ['figure', 'fit', join(PEOPLE, 'sofia.json'), '--measures', measures, '--output', person]) ?? '';
  for (const [name, value] of Object.entries(wanted)) {
    const [, after] = new RegExp(`^${name} +\\S+ +(\\S+)`, 'm').exec(told) ?? [];
    if (!(Math.abs(Number(after) - value) < NEAR)) throw new Stop(`${name} comes to ${after} deviations, not to ${value}.`);
  }
}

await main(async () => {
  run(process.execPath, ['web/tools/model.mjs'], { why: 'The body model' });
  const folder = mkdtempSync(join(tmpdir(), 'people-'));
  try {
    binds(folder);
    fits(folder);
  } finally {
    rmSync(folder, { recursive: true });
  }
  run(raconteur, ['figure', 'crowd', STORY, '--count', String(CROWD)], { why: `A crowd of ${CROWD}` });
});
