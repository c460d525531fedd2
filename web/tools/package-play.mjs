// What the checks of the packed files have in common: a server of an application's files, and a browser that plays its story.

import { existsSync } from 'node:fs';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { extname, join } from 'node:path';
import { chromium } from '@playwright/test';
import { chromiumArgs } from './chromium.mjs';
import { Stop } from './steps.mjs';

export const STORY = 'raconteur/stories/hello-world/story.eml';
/** The parts of the library that the story needs. */
export const PARTS = 'figures,animations,stories,player';
const SAID = 'Hello world!';
/** What says what has no recording. */
const VOICE = 'flite';
const PLAYED_MS = 60_000;
const TYPES = { '.html': 'text/html', '.js': 'text/javascript', '.mjs': 'text/javascript', '.wasm': 'application/wasm', '.css': 'text/css' };

/** Serves a folder; with `cors` to pages of other origins too. */
export async function serve(served, { cors = false } = {}) {
  const server = createServer(async ({ url = '/' }, response) => {
    const path = decodeURIComponent(url.split('?')[0] ?? '/');
    const file = join(served, path.endsWith('/') ? `${path}index.html` : path);
    const bytes = await readFile(file).catch(() => undefined);
    const headers = { 'content-type': TYPES[extname(file)] ?? 'application/octet-stream', ...(cors ? { 'access-control-allow-origin': '*' } : {}) };
    if (bytes === undefined) response.writeHead(404).end();
    else response.writeHead(200, headers).end(bytes);
  });
  await new Promise((listening) => server.listen(0, '127.0.0.1', listening));
  return { address: `http://127.0.0.1:${server.address().port}/`, close: () => server.close() };
}

export async function openBrowser() {
  const system = process.env['CHROMIUM'] ?? '/usr/bin/chromium';
  return await chromium.launch({ args: chromiumArgs, ...(existsSync(system) ? { executablePath: system } : {}) });
}

/** In the page: plays to the end. With a button that is the application's, and what its own listener shows is told as well. */
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

/** In the page: has a text spoken that has no recording; who speaks it. That is a worker of its own, with modules of its own. */
async function speak(most) {
  const player = document.querySelector('raconteur-player');
  const voice = new Promise((done) => player.addEventListener('voicechange', ({ detail }) => done(detail.name)));
  await player.rehearse("<eml><body><voice-text time='0'>Good morning.</voice-text></body></eml>");
  player.currentTime = 0;
  player.play();
  const silence = new Promise((done) => setTimeout(() => done(undefined), most));
  return { voice: await Promise.race([voice, silence]), problems: player.diagnostics.map(({ message }) => message) };
}

/** Plays the story of a page to its end. Stops where it is not told as it should be. `button`: the one that plays; `picture`: where a picture of the end is written. */
export async function play(browser, name, address, { button, picture } = {}) {
  const tab = await browser.newPage({ viewport: { width: 800, height: 700 } });
  const faults = [];
  tab.on('pageerror', (error) => faults.push(error.message));
  try {
    // Pages that a server has made are idle when their scripts have taken them over.
    await tab.goto(address, { waitUntil: 'networkidle' });
    const played = await Promise.race([tab.evaluate(perform, { most: PLAYED_MS, button }), undefinedElement(tab)]);
    if (picture !== undefined) await tab.screenshot({ path: picture });
    const told = { ...played, ...(played.outcome === 'ended' && (await tab.evaluate(speak, PLAYED_MS))) };
    // On a slow machine one picture may come after several words.
    const isShown = button === undefined || told.shown.at(-1) === told.words.at(-1);
    if (told.outcome !== 'ended' || told.words.join(' ') !== SAID || !isShown || told.voice !== VOICE || faults.length > 0) throw new Stop(`${name} does not play: ${JSON.stringify({ ...told, faults })}`);
    return told;
  } finally {
    await tab.close();
  }
}

/** Gives up on a page that does not define the element. */
async function undefinedElement(tab) {
  await new Promise((late) => setTimeout(late, PLAYED_MS + 15_000));
  return { outcome: 'undefined', words: [], shown: [], title: await tab.title().catch(() => '') };
}
