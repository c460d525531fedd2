#!/usr/bin/env node
// Copies the library of figures, animations, faces, music and stories into a folder that a page serves, and of the player what a
// page's build may leave behind: its modules and workers.

import { cpSync, readdirSync } from 'node:fs';
import { dirname, join, resolve } from 'node:path';
import { fileURLToPath } from 'node:url';
import { parseArgs } from 'node:util';

const library = join(dirname(fileURLToPath(import.meta.url)), 'library');
const PLAYER = 'player';
const parts = [...readdirSync(library), PLAYER];
const usage = `Usage: raconteur-assets FOLDER [--only ${parts.join(',')}]`;

function fail(message) {
  console.error(`raconteur-assets: ${message}\n${usage}`);
  process.exit(1);
}

/** Where the installed player has its files. */
function playerFiles() {
  try {
    return join(dirname(fileURLToPath(import.meta.resolve('@raconteur/player/package.json'))), 'dist');
  } catch {
    return fail('@raconteur/player is not installed beside it');
  }
}

let given;
try {
  given = parseArgs({ allowPositionals: true, options: { only: { type: 'string' }, help: { type: 'boolean', short: 'h' } } });
} catch (error) {
  fail(error.message);
}
if (given.values.help) console.log(usage);
else {
  const [folder, ...others] = given.positionals;
  if (folder === undefined || others.length > 0) fail('one folder is wanted');
  const wanted = given.values.only?.split(',') ?? parts;
  const unknown = wanted.find((part) => !parts.includes(part));
  if (unknown !== undefined) fail(`there is no part ${unknown}`);
  for (const part of wanted) cpSync(part === PLAYER ? playerFiles() : join(library, part), join(resolve(folder), part), { recursive: true });
  console.log(`${wanted.join(', ')} copied to ${folder}`);
}
