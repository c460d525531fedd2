// Shared parts of the checks of the packed files: a server of an application's files, and a browser
// that plays its story.

import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { chromium } from '@playwright/test';
import { chromiumArgs } from './chromium.mjs';
import { run, Stop } from './steps.mjs';

export const STORY = 'raconteur/stories/hello-world/story.eml';
const SAID = 'Hello world!';
/** Default voices for speech without a recording, by language. */
const VOICES = { en: 'flite', de: 'espeak-ng' };
const PLAYED_MS = 60_000;
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.css': 'text/css' };

/** Strict policy of a careful server: only the page's own files and wasm. */
const STRICT = {
  'content-security-policy':
    "default-src 'none'; script-src 'self' 'wasm-unsafe-eval'; style-src 'self'; img-src 'self' data:; connect-src 'self'; media-src 'self'; base-uri 'none'; require-trusted-types-for 'script'; trusted-types raconteur lit-html",
};

/** Serves a folder; with `cors` to pages of other origins too, `strict` under a policy. */
export async function serve(served, { cors = false, strict = false } = {}) {
  const server = createServer(async ({ url = '/' }, response) => {
    const path = decodeURIComponent(url.split('?')[0] ?? '/');
    const file = join(served, path.endsWith('/') ? `${path}index.html` : path);
    const bytes = await readFile(file).catch(() => undefined);
    const headers = { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream', ...(cors && { 'access-control-allow-origin': '*' }), ...(strict && STRICT) };
    if (bytes === undefined) response.writeHead(404).end();
    else response.writeHead(200, headers).end(bytes);
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

/** Runs the command of the package of the library, as an application's folder has it. */
export function copyLibrary(app, library, choices) {
  run(process.execPath, [join(library, 'command.mjs'), 'public/raconteur', ...choices], { cwd: app, stdio: 'ignore', why: 'Copying the library' });
}

export async function openBrowser() {
  const system = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
  return await chromium.launch({ args: chromiumArgs, ...(existsSync(system) ? { executablePath: system } : {}) });
}

/** Runs in the page: plays to the end. With a button of the application, the output of its own listener is returned too. */
async function perform({ most, button }) {
  await customElements.whenDefined('raconteur-player');
  const player = document.querySelector('raconteur-player');
  const words = [];
  const shown = [];
  player.addEventListener('word', ({ detail }) => words.push(detail.word.text));
  const ended = new Promise((done) => player.addEventListener('ended', () => done('ended')));
  const late = new Promise((done) => setTimeout(() => done('late'), most));
  if (button === undefined) await player.play();
  else {
    const output = document.querySelector('output');
    new MutationObserver(() => shown.push(output.textContent)).observe(output, { childList: true, characterData: true, subtree: true });
    document.querySelector(button).click();
  }
  const outcome = await Promise.race([ended, late]);
  return { outcome, words, shown, error: player.error?.message };
}

/** Runs in the page: speaks a text of a language without a recording; returns the voice. It runs in a separate worker with its own modules. */
async function speak({ language, most }) {
  const player = document.querySelector('raconteur-player');
  let name;
  player.addEventListener('voicechange', ({ detail }) => (name = detail.name));
  // The voice has loaded completely by then, and runs.
  const voice = new Promise((done) => player.addEventListener('voiceprogress', ({ detail }) => detail.share === 1 && done(name)));
  const head = `<head><r:performer language='${language}'/></head>`;
  await player.rehearse(`<eml xmlns:r='urn:raconteur:eml:1'>${head}<body><voice-text time='0'>Hello, hallo.</voice-text></body></eml>`);
  player.currentTime = 0;
  player.play();
  const silence = new Promise((done) => setTimeout(() => done(undefined), most));
  return { voice: await Promise.race([voice, silence]), problems: player.diagnostics.map(({ message }) => message) };
}

/**
 * Plays the story of a page to its end, then a text in each of the `languages`. Stops with an error if the result differs. `button`: the play button;
 * `picture`: path for a screenshot of the end.
 */
export async function play(browser, name, address, { button, picture, languages = ['en'] } = {}) {
  const tab = await browser.newPage({ viewport: { width: 800, height: 700 } });
  const faults = [];
  tab.on('pageerror', (error) => faults.push(error.message));
  try {
    // Server-rendered pages are idle when their scripts have hydrated them.
    await tab.goto(address, { waitUntil: 'networkidle' });
    const played = await Promise.race([tab.evaluate(perform, { most: PLAYED_MS, button }), undefinedElement(tab)]);
    if (picture !== undefined) await tab.screenshot({ path: picture });
    const spoken = [];
    if (played.outcome === 'ended') for (const language of languages) spoken.push(await tab.evaluate(speak, { language, most: PLAYED_MS }));
    const told = { ...played, spoken };
    const isSpoken = languages.every((language, at) => spoken[at]?.voice === VOICES[language]);
    // On a slow machine one frame may come after several words.
    const isShown = button === undefined || told.shown.at(-1) === told.words.at(-1);
    if (told.outcome !== 'ended' || told.words.join(' ') !== SAID || !isShown || !isSpoken || faults.length > 0) throw new Stop(`${name} does not play: ${JSON.stringify({ ...told, faults })}`);
    return told;
  } finally {
    await tab.close();
  }
}

/** Stops with an error if a page that cannot play does not explain why. */
export async function refuse(browser, address, sentence) {
  const tab = await browser.newPage();
  try {
    const fault = tab.waitForEvent('pageerror', { timeout: PLAYED_MS });
    await tab.goto(address);
    const { message } = await fault;
    if (!message.includes(sentence)) throw new Stop(`A page that cannot play says: ${message}`);
  } finally {
    await tab.close();
  }
}

/** Runs in the page: returns the reports for a text that no voice speaks, twice. */
async function miss(most) {
  await customElements.whenDefined('raconteur-player');
  const player = document.querySelector('raconteur-player');
  const told = () => player.diagnostics.filter(({ code }) => code === 'voice-not-installed');
  const until = performance.now() + most;
  for (const text of ['Good morning.', 'Good night.']) {
    await player.rehearse(`<eml><body><voice-text time='0'>${text}</voice-text></body></eml>`);
    player.currentTime = 0;
    await player.play();
    while (told().length === 0 && performance.now() < until) await new Promise((later) => setTimeout(later, 50));
  }
  return told().map(({ message, hints }) => [message, ...hints].join(' '));
}

/** Checks that a page reports once that the default voice is not installed. */
export async function playWithoutVoice(browser, address) {
  const tab = await browser.newPage();
  try {
    await tab.goto(address);
    const told = await tab.evaluate(miss, PLAYED_MS);
    if (told.length !== 1 || !told[0].includes('--voices flite')) throw new Stop(`A page without a voice tells: ${JSON.stringify(told)}`);
    return told[0];
  } finally {
    await tab.close();
  }
}

/** Fails on a page that does not define the element. */
async function undefinedElement(tab) {
  await new Promise((late) => setTimeout(late, PLAYED_MS + 15_000));
  return { outcome: 'undefined', words: [], shown: [], title: await tab.title().catch(() => '') };
}
