// Measures the effect of markup and emotions on voices: `node web/tools/voices.mjs` updates the
// tables of docs/voices.md. `--check PROGRAM` only measures, with an existing program: one setting
// of each kind for a voice of each engine, or everything if TEST_LONG is set. Both fail if a
// setting misses its target. Needs the engines (see `system` in setup.mjs). Uses only Node's own
// modules.

import { execFile } from 'node:child_process';
import { readFileSync, writeFileSync } from 'node:fs';
import { availableParallelism } from 'node:os';
import { join } from 'node:path';
import { targetFolder } from './kept.mjs';
import { main, root, run, Stop } from './steps.mjs';

/** Engine, voice, column heading, and true if it represents its engine. */
const voices = [
  ['festival', 'cmu_us_slt_arctic_hts', 'Festival<br>slt_hts', true],
  ['festival', 'kal_diphone', 'Festival<br>kal'],
  ['flite', 'rms', 'flite<br>rms', true],
  ['flite', 'slt', 'flite<br>slt'],
  ['espeak-ng', 'en-us', 'espeak<br>en-us'],
  ['espeak-ng', 'de', 'espeak<br>de', true],
  ['espeak-ng', 'pt', 'espeak<br>pt'],
];

const document = join(root, 'docs/voices.md');
const begin = '<!-- measured: begin -->';
const end = '<!-- measured: end -->';

/** Returns true for rows of emotions, which are named by a dimension and its value; others are named by their markup. */
const isEmotion = (row) => /^(activation|evaluation|power) /.test(row.setting);

/** Measures a voice: rows of `setting`, `property`, `asked`, `heard`, `error` and `ok`. */
function measure(program, options, [engine, voice]) {
  const args = ['voice', 'measure', '--engine', engine, '--voice', voice, '--format', 'json', ...options];
  return new Promise((done, fail) => {
    execFile(program, args, { cwd: root, maxBuffer: 1 << 24 }, (error, stdout, stderr) => {
      // The exit status also reports that a setting missed its target, but the rows give the
      // details.
      try {
        const rows = JSON.parse(stdout);
        console.log(`  ${engine}:${voice}: ${rows.filter((row) => row.ok).length} of ${rows.length} settings as asked`);
        done(rows);
      } catch {
        fail(new Stop(`${engine}:${voice} was not measured: ${stderr.trim() || (error?.message ?? 'it printed nothing')}`));
      }
    });
  });
}

/** Measures all voices, as many at a time as there are processors; in their order. */
async function measureAll(program, options, voices) {
  const measured = new Array(voices.length);
  let next = 0;
  const work = async () => {
    for (let i = next++; i < voices.length; i = next++) measured[i] = await measure(program, options, voices[i]);
  };
  await Promise.all(Array.from({ length: Math.min(availableParallelism(), voices.length) }, work));
  return measured;
}

/** Formats a number with three digits and a proper minus. */
const figure = (x) => Number(x.toFixed(Math.abs(x) < 10 ? 2 : 1)).toString().replace('-', '−');

/** Formats a value; NaN is encoded as null. */
function cell(row) {
  if (row === undefined) return '–';
  const heard = row.heard === null || row.error === null ? '?' : `${figure(row.heard)}, ${Math.round(row.error * 100)} %`;
  return row.ok ? heard : `**${heard}**`;
}

/** Returns a table of the wanted rows: one row per setting, one column per voice. */
function table(measured, wanted) {
  const name = (row) => `${row.setting}\0${row.property}`;
  const asked = new Map();
  for (const row of measured.flat()) if (wanted(row) && !asked.has(name(row))) asked.set(name(row), row);
  const head = ['setting', 'property', 'asked', ...voices.map(([, , title]) => title)];
  const lines = [...asked].map(([key, row]) => {
    const setting = isEmotion(row) ? row.setting.replace('-', '−') : `\`${row.setting}\``;
    const heard = measured.map((rows) => cell(rows.find((other) => name(other) === key)));
    return [setting, row.property, figure(row.asked), ...heard];
  });
  return [head, head.map((_, i) => (i < 2 ? '---' : '--:')), ...lines].map((fields) => `| ${fields.join(' | ')} |`).join('\n');
}

/** Returns the content between the two marks of the document. */
function tables(measured) {
  return `## Measured

Each field gives the measured value and its difference from the request. Settings that fail are bold; a dash is a
setting that was not requested of the voice. Lengths, paces, pitches, ranges and amplitudes are factors on the plain
voice. Semitones and decibels may differ by 15 % of the request, or by half a semitone or decibel, which is less than
listeners notice.

### Markup

${table(measured, (row) => !isEmotion(row))}

### Emotions

One dimension alone, at +50 and −50.

${table(measured, isEmotion)}`;
}

/** Builds the command line as it is shipped, and returns its path. */
function build() {
  run('cargo', ['build', '--locked', '--release', '--package', 'raconteur-cli'], { why: 'Building the command line' });
  return join(targetFolder(), 'release', process.platform === 'win32' ? 'raconteur.exe' : 'raconteur');
}

await main(async () => {
  const [mode, given, ...rest] = process.argv.slice(2);
  const isCheck = mode === '--check' && given !== undefined;
  if (rest.length > 0 || (mode !== undefined && !isCheck)) throw new Stop('Usage: node web/tools/voices.mjs [--check PROGRAM]');
  const samples = isCheck && process.env['TEST_LONG'] === undefined;
  const wanted = samples ? voices.filter(([, , , stands]) => stands) : voices;
  const measured = await measureAll(isCheck ? given : build(), samples ? ['--sample'] : [], wanted);
  if (mode === undefined) {
    const text = readFileSync(document, 'utf8');
    const [from, to] = [text.indexOf(begin), text.indexOf(end)];
    if (from < 0 || to < from) throw new Stop('docs/voices.md has lost the marks between which the tables stand.');
    writeFileSync(document, `${text.slice(0, from + begin.length)}\n\n${tables(measured)}\n\n${text.slice(to)}`);
  }
  const missed = measured.flatMap((rows, i) => rows.filter((row) => !row.ok).map((row) =>
    `${wanted[i][0]}:${wanted[i][1]}: ${row.setting}, ${row.property}: asked ${row.asked}, heard ${row.heard}`));
  if (missed.length > 0) throw new Stop(`Not as asked:\n${missed.join('\n')}`);
});
