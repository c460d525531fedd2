// `npm run bench:peer -- --avatar FILE.glb [--rounds N] [--quality Q] [--backend B]`: plays the same sentences here and
// by TalkingHead (https://github.com/met4citizen/TalkingHead, MIT, fetched from npm), on pages of the same size in
// the same Chromium, in turns, and prints how they compare.

import { existsSync, mkdirSync, readFileSync, writeFileSync } from 'node:fs';
import { join, resolve } from 'node:path';
import { brotliCompressSync, constants } from 'node:zlib';
import { chromiumArgs } from './chromium.mjs';
import { chromium, page as build, system } from './setup.mjs';
import { main, once, root, run, serverOptions, Stop } from './steps.mjs';

const PACKAGES = { '@met4citizen/talkinghead': '1.7.0', three: '0.180.0' };
const FOLDER = '.setup/peer';
const PAGE = { width: 1000, height: 700 };
/** Durations of play, milliseconds: the first, in which a player finds its quality, is excluded; the second is measured. */
const [SETTLES_MS, MEASURED_MS] = [3000, 8000];
const USAGE = 'npm run bench:peer -- --avatar FILE.glb [--rounds 3] [--quality auto] [--backend webgl]';

/** Measures: name, unit, reader, and true if higher is better. */
const MEASURES = [
  ['frames a second', '', (m) => m.framesPerSecond, true],
  ['worst task', ', ms', (m) => m.worstTaskMs, false],
  ['main thread at work', ', %', (m) => 100 * m.busy, false],
  ['script a frame', ', ms', (m) => m.scriptMs, false],
  ['first picture', ', ms', (m) => m.firstPictureMs, false],
  ['bytes by brotli', ', KB', (m) => m.bytes / 1000, false],
];

const TYPES = { html: 'text/html', js: 'text/javascript', mjs: 'text/javascript', css: 'text/css', glb: 'model/gltf-binary' };

/** Serves the two pages, the peer's packages and its avatar, without the content security policy of the project's pages. */
function peerFiles(avatar) {
  const folders = { '/bench/': join(root, 'web/tools/peer'), '/peer/': join(root, FOLDER) };
  return {
    name: 'peer',
    configurePreviewServer(server) {
      server.middlewares.use((request, response, next) => {
        const { pathname } = new URL(request.url ?? '/', 'http://localhost');
        const prefix = Object.keys(folders).find((folder) => pathname.startsWith(folder));
        if (prefix === undefined) return next();
        const file = pathname === '/peer/avatar.glb' ? avatar : join(folders[prefix], pathname.slice(prefix.length));
        if (!existsSync(file)) return response.writeHead(404).end();
        return response.writeHead(200, { 'Content-Type': TYPES[file.split('.').at(-1)] ?? 'application/octet-stream' }).end(readFileSync(file));
      });
    },
  };
}

/** Counts frames and long tasks while the page speaks; runs in the page. */
async function watch([settlesMs, measuredMs]) {
  const tasks = [];
  new PerformanceObserver((list) => tasks.push(...list.getEntries())).observe({ entryTypes: ['longtask'] });
  await globalThis.bench.speak();
  const wait = (ms) => new Promise((resolve) => setTimeout(resolve, ms));
  await wait(settlesMs);
  await globalThis.measureBegins();
  const start = performance.now();
  let frames = 0;
  await new Promise((done) => {
    const frame = () => {
      frames += 1;
      if (performance.now() - start < measuredMs) requestAnimationFrame(frame);
      else done();
    };
    requestAnimationFrame(frame);
  });
  const seconds = (performance.now() - start) / 1000;
  const worst = Math.max(0, ...tasks.filter((task) => task.startTime >= start).map((task) => task.duration));
  return { frames, framesPerSecond: frames / seconds, worstTaskMs: worst, state: globalThis.bench.state() };
}

async function measure(chrome, address) {
  const context = await chrome.newContext({ viewport: PAGE });
  const page = await context.newPage();
  const client = await context.newCDPSession(page);
  await client.send('Performance.enable');
  const spent = async () => {
    const { metrics } = await client.send('Performance.getMetrics');
    return Object.fromEntries(metrics.map(({ name, value }) => [name, value]));
  };
  const bodies = [];
  page.on('response', (response) => bodies.push(response.body().catch(() => Buffer.alloc(0))));
  let before;
  await page.exposeFunction('measureBegins', async () => {
    before = await spent();
  });
  await page.goto(address);
  const firstPictureMs = await page.evaluate(async () => {
    await globalThis.bench.ready;
    return performance.now();
  });
  const fetched = await Promise.all(bodies);
  const seen = await page.evaluate(watch, [SETTLES_MS, MEASURED_MS]);
  const after = await spent();
  await context.close();
  const options = { params: { [constants.BROTLI_PARAM_QUALITY]: 9 } };
  return {
    ...seen,
    firstPictureMs,
    busy: (after.TaskDuration - before.TaskDuration) / (after.Timestamp - before.Timestamp),
    scriptMs: (1000 * (after.ScriptDuration - before.ScriptDuration)) / seen.frames,
    bytes: fetched.reduce((sum, body) => sum + brotliCompressSync(body, options).length, 0),
  };
}

const median = (values) => [...values].sort((a, b) => a - b)[values.length >> 1];
const spread = (values, digits) => `${median(values).toFixed(digits)} (${Math.min(...values).toFixed(digits)} to ${Math.max(...values).toFixed(digits)})`;

function report(rounds) {
  for (const [name, unit, read, more] of MEASURES) {
    const [ours, theirs] = ['ours', 'theirs'].map((who) => rounds.map((round) => read(round[who])));
    const ratios = ours.map((value, i) => value / theirs[i]);
    // Tasks shorter than 50 ms are not reported and count as none.
    const ratio = ratios.every(Number.isFinite) ? `; ours is ${spread(ratios, 2)} of theirs` : '';
    console.log(`${name}${unit}: ours ${spread(ours, 1)}, theirs ${spread(theirs, 1)}${ratio} (${more ? 'more' : 'less'} is better)`);
  }
}

/** Installs the peer and the version of three.js for which it was made. */
async function packages() {
  await once('peer-packages', { inputs: [], extra: JSON.stringify(PACKAGES), outputs: [`${FOLDER}/node_modules/three/package.json`] }, () => {
    mkdirSync(join(root, FOLDER), { recursive: true });
    writeFileSync(join(root, FOLDER, 'package.json'), JSON.stringify({ private: true, dependencies: PACKAGES }));
    run('npm', ['install', '--prefix', FOLDER, '--no-audit', '--no-fund', '--ignore-scripts'], { why: 'Fetching the peer' });
  });
}

await main(async () => {
  const values = serverOptions(USAGE, { avatar: { type: 'string' }, rounds: { type: 'string' }, quality: { type: 'string' }, backend: { type: 'string' } });
  const { avatar, port, rounds: count = '3', quality = 'auto', backend } = values;
  if (avatar === undefined || !existsSync(avatar)) throw new Stop(`--avatar wants a glTF file of the peer's kind, ${avatar === undefined ? 'and there is none' : `not ${avatar}`}.\n${USAGE}`);
  if (!(Number.isInteger(Number(count)) && Number(count) > 0)) throw new Stop(`--rounds wants a number from 1, not ${count}.`);
  await build();
  await system('browser');
  await packages();
  const { preview } = await import('vite');
  const server = await preview({ root, logLevel: 'warn', plugins: [peerFiles(resolve(avatar))], preview: { port: port ?? 4199, headers: {} } });
  const { chromium: engine } = await import('@playwright/test');
  const chrome = await engine.launch({ executablePath: chromium(), args: chromiumArgs });
  const host = server.resolvedUrls.local[0];
  const query = new URLSearchParams({ quality, ...(backend && { backend }) });
  const addresses = { ours: `${host}bench/ours.html?${query}`, theirs: `${host}bench/theirs.html` };
  const rounds = [];
  for (let round = 0; round < Number(count); round += 1) {
    const order = round % 2 === 0 ? ['ours', 'theirs'] : ['theirs', 'ours'];
    const result = {};
    for (const who of order) {
      result[who] = await measure(chrome, addresses[who]);
      console.log(`round ${round + 1}, ${who}: ${result[who].framesPerSecond.toFixed(1)} frames a second, ${JSON.stringify(result[who].state)}`);
    }
    rounds.push(result);
  }
  await chrome.close();
  await server.close();
  report(rounds);
});
