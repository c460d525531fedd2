// Writes the tested examples into docs/embedding.md: `node web/tools/embedding.mjs`. The files are
// inserted between `<!-- example PATH… -->` and `<!-- /example -->`. Of a file with lines `[guide`
// and `guide]`, only the parts between them are inserted; after `[guide 6` they are indented by six
// spaces.

import { readFileSync, writeFileSync } from 'node:fs';
import { extname, join } from 'node:path';
import { pathToFileURL } from 'node:url';
import { root, Stop } from './steps.mjs';

const guide = join(root, 'docs/embedding.md');
const LANGUAGES = { '.mjs': 'js', '.svelte': 'svelte', '.vue': 'vue' };

/** Reindents lines so that the least indented one has this number of spaces. */
function indented(lines, spaces) {
  const least = Math.min(...lines.filter((line) => line.trim() !== '').map((line) => line.search(/\S/)));
  return lines.map((line) => (line.trim() === '' ? '' : ' '.repeat(spaces) + line.slice(least)));
}

/** Returns the part of an example's file shown in the guide. */
export function shown(text) {
  const lines = text.trimEnd().split(/\r?\n/);
  if (!text.includes('[guide')) return lines;
  const pieces = [];
  let piece;
  let spaces;
  for (const line of lines) {
    const begins = /\[guide(?: (\d+))?/.exec(line);
    if (begins !== null) {
      piece = [];
      spaces = begins[1];
    } else if (line.includes('guide]')) {
      pieces.push(...(spaces === undefined ? piece : indented(piece, Number(spaces))));
      piece = undefined;
    } else piece?.push(line);
  }
  if (piece !== undefined) throw new Stop('A piece for the guide has no end.');
  return pieces;
}

function fenced(path) {
  const type = extname(path);
  return ['```' + (LANGUAGES[type] ?? type.slice(1)), ...shown(readFileSync(join(root, 'examples', path), 'utf8')), '```'].join('\n');
}

/** Returns the guide with the current examples. */
export function written(text) {
  return text.replace(/(<!-- example (.+?) -->\n)[^]*?(<!-- \/example -->)/g, (_, begin, paths, end) => `${begin}\n${paths.split(' ').map(fenced).join('\n\n')}\n\n${end}`);
}

export const read = () => readFileSync(guide, 'utf8');

if (import.meta.url === pathToFileURL(process.argv[1] ?? '').href) writeFileSync(guide, written(read()));
