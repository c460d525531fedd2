#!/usr/bin/env node
// Copies the files that a page serves into a folder: the chosen stories and figures of the library,
// with the files that they use; the modules and workers of the player that a page's build may omit;
// and the files of installed voices.

import { cpSync, readdirSync, readFileSync, statSync } from 'node:fs';
import { createRequire } from 'node:module';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const own = dirname(fileURLToPath(import.meta.url));
const library = join(own, 'library');
/** Assets used by each story, by name. */
const uses = JSON.parse(readFileSync(join(own, 'uses.json'), 'utf8'));
const USUAL = 'hello-world';
/** Folders that are always included: any story may name one of their files, and they are small. */
const ALWAYS = ['animations', 'hand-shapes'];
const VOICE = '@raconteur/voice-';

/** The names of the files of a folder with an ending, without it. */
const namesIn = (folder, ending) =>
  readdirSync(join(library, folder))
    .filter((name) => name.endsWith(ending))
    .map((name) => name.slice(0, -ending.length));

const there = { stories: Object.keys(uses), figures: namesIn('figures', '.glb'), music: namesIn('music', '.opus') };

const usage = `Usage: raconteur-library FOLDER [--stories A,B] [--figures A,B] [--music A,B] [--faces] [--voices A,B] [--all]

Copies into FOLDER, which a page serves and the attribute "assets" names:
  --stories  stories with their figures and music: ${there.stories.join(', ')}
  --figures  figures: ${there.figures.join(', ')}
  --music    pieces of music: ${there.music.join(', ')}
  --faces    the model of faces
  --voices   voices of installed packages: flite of ${VOICE}flite, kokoro, espeak; alone, nothing else
  --all      the whole library
Without a choice: what the story ${USUAL} needs.`;

function fail(message) {
  console.error(`raconteur-library: ${message}\n\n${usage}`);
  process.exit(1);
}

/** Returns the folder of an installed package, as resolved from the page's own folder, or else from this package. */
function installed(name) {
  for (const from of [join(process.cwd(), 'package.json'), fileURLToPath(import.meta.url)]) {
    try {
      return dirname(createRequire(from).resolve(`${name}/package.json`));
    } catch {
      // The other one may have it.
    }
  }
  return fail(`${name} is not installed: run "npm install ${name}"`);
}

function sizeOf(path) {
  if (!statSync(path).isDirectory()) return statSync(path).size;
  return readdirSync(path).reduce((sum, name) => sum + sizeOf(join(path, name)), 0);
}

/** Copies folders and files, `from` to `to` below the page's folder, and reports their sizes. */
function copy(to, parts) {
  for (const [place, from] of parts) {
    cpSync(from, join(to, place), { recursive: true });
    console.log(`${(sizeOf(from) / 1e6).toFixed(1).padStart(6)} MB  ${place}`);
  }
}

const story = (name) => [`stories/${name}`, join(library, 'stories', name)];
const figure = (name) => [`figures/${name}.glb`, join(library, `figures/${name}.glb`)];
/** Browsers without the first kind of sound play the second. */
const piece = (name) => ['opus', 'mp3'].map((ending) => `music/${name}.${ending}`).map((path) => [path, join(library, path)]);
const player = () => ['player', join(installed('@raconteur/player'), 'dist')];

/** Voices, each once, with those that they need. */
function voices(names) {
  const wanted = new Set(names);
  for (const name of wanted) {
    const { dependencies = {} } = JSON.parse(readFileSync(join(installed(`${VOICE}${name}`), 'package.json'), 'utf8'));
    for (const other of Object.keys(dependencies)) if (other.startsWith(VOICE)) wanted.add(other.slice(VOICE.length));
  }
  return [...wanted].map((name) => [`voices/${name}`, join(installed(`${VOICE}${name}`), 'dist')]);
}

/** Returns the chosen assets with their dependencies. */
function chosen({ stories, figures, music, faces }) {
  const withUsed = (what, names) => [...new Set([...names, ...stories.flatMap((name) => uses[name][what])])];
  return [
    ...stories.map(story),
    ...withUsed('figures', figures).map(figure),
    ...withUsed('music', music).flatMap(piece),
    ...(faces ? [['faces', join(library, 'faces')]] : []),
    ...ALWAYS.map((part) => [part, join(library, part)]),
    player(),
  ];
}

/** Returns the names given to an option, each of which must exist. */
function names(option, given) {
  const wanted = given?.split(',').filter(Boolean) ?? [];
  const unknown = wanted.find((name) => !there[option].includes(name));
  if (unknown !== undefined) fail(`--${option}: there is no ${unknown}`);
  return wanted;
}

function parse() {
  const name = { type: 'string' };
  const flag = { type: 'boolean' };
  try {
    return parseArgs({ allowPositionals: true, options: { stories: name, figures: name, music: name, voices: name, faces: flag, all: flag, help: { ...flag, short: 'h' } } });
  } catch (error) {
    return fail(error.message);
  }
}

function run({ values, positionals: [folder, ...others] }) {
  if (folder === undefined || others.length > 0) fail('one folder is wanted');
  const to = resolve(folder);
  const choice = { stories: names('stories', values.stories), figures: names('figures', values.figures), music: names('music', values.music), faces: values.faces };
  const isChosen = [choice.stories, choice.figures, choice.music].some(({ length }) => length > 0) || values.faces;
  const voiced = voices(values.voices?.split(',').filter(Boolean) ?? []);
  const isUsual = !isChosen && !values.all && voiced.length === 0;
  if (values.all) copy(to, [...readdirSync(library).map((part) => [part, join(library, part)]), player()]);
  else if (isChosen) copy(to, chosen(choice));
  else if (isUsual) copy(to, chosen({ ...choice, stories: [USUAL] }));
  copy(to, voiced);
  if (isUsual) console.log(`\nThis is what the story ${USUAL} needs; other choices:\n\n${usage}`);
}

const given = parse();
if (given.values.help) console.log(usage);
else run(given);
