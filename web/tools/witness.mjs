// `node web/tools/witness.mjs`: evaluates the baked stories with independent programs: the start
// times of their words (PocketSphinx), and the predicted listener rating of their audio (DNSMOS
// P.808). Fetches Python packages into `.setup/witnesses`; no other tool of the repository needs
// them. Uses only Node's own modules.

import { existsSync, readdirSync } from 'node:fs';
import { join } from 'node:path';
import { ask, main, once, root, run, Stop } from './steps.mjs';

const LIST = 'web/tools/witness.txt';
const FOLDER = '.setup/witnesses';
const PYTHON = join(root, FOLDER, process.platform === 'win32' ? 'Scripts/python.exe' : 'bin/python');

/**
 * Minimum score of a story, the mean of its utterances, and maximum deviation of word starts, in the median and in one of twenty, milliseconds. Single words,
 * as in the lesson and the greeting, are rated lower; the timing of verse depends on its breaks.
 */
const BOUNDS = {
  'stories/white-rabbit': { p808: 4.1, medianMs: 30, mostMs: 80 },
  'stories/virtual-poets/jabberwocky': { p808: 4.1, medianMs: 30, mostMs: 100 },
  'stories/step-lesson': { p808: 3.7, medianMs: 30, mostMs: 80 },
  'stories/hello-world': { p808: 3.7 },
  'courses/how-a-story-is-told': { p808: 4, medianMs: 30, mostMs: 80 },
};

/** All speech bundles of the library. */
const bundles = readdirSync(join(root, 'assets'), { recursive: true })
  .filter((path) => path.endsWith('speech.json'))
  .map((path) => path.replaceAll('\\', '/').replace('/voice/speech.json', ''))
  .sort();

await main(async () => {
  await once('witness', { inputs: [LIST], outputs: [PYTHON] }, () => {
    const python = ['python3', 'python'].find((name) => ask(name, ['-m', 'pip', '--version']) !== undefined);
    if (python === undefined) throw new Stop('The witnesses are Python packages: install Python with pip, then run this again.');
    run(python, ['-m', 'venv', FOLDER], { why: 'A place for the witnesses' });
    run(PYTHON, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--requirement', LIST], { why: 'Fetching the witnesses' });
  });
  const folders = bundles.map((story) => join(root, 'assets', story, 'voice'));
  const lines = ask(PYTHON, ['web/tools/witness.py', ...folders])?.trim().split('\n') ?? [];
  if (lines.length !== bundles.length) throw new Stop(`The witnesses heard ${lines.length} of ${bundles.length} stories.`);
  const missed = lines.flatMap((line, i) => {
    const heard = JSON.parse(line);
    const [story, bounds = {}] = [bundles[i], BOUNDS[bundles[i]]];
    const told = [`P.808 ${heard.p808.toFixed(2)}`];
    if (heard.medianMs !== null) told.push(`${heard.words} words begin ${heard.medianMs.toFixed(0)} ms off in the middle, 95 % of them within ${heard.mostMs.toFixed(0)} ms`);
    console.log(`  ${story}: ${told.join('; ')}`);
    const isMissed = heard.p808 < (bounds.p808 ?? 0) || heard.medianMs > (bounds.medianMs ?? Infinity) || heard.mostMs > (bounds.mostMs ?? Infinity);
    return isMissed ? [story] : [];
  });
  const unknown = Object.keys(BOUNDS).filter((story) => !existsSync(join(root, 'assets', story, 'voice')));
  if (missed.length + unknown.length > 0) throw new Stop(`Worse than they were: ${[...missed, ...unknown].join(', ')}.`);
});
