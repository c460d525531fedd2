// What several pages of the site say is written once, in web/pages/parts.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const folder = join(import.meta.dirname, '../pages/parts');

/** Puts parts into a text in the place of `<!-- part: NAME -->`, indented as that; parts may have parts. */
export function withParts(text: string): string {
  return text.replace(/^( *)<!-- part: ([\w-]+) -->$/gm, (_, indent: string, name: string) => {
    const part = readFileSync(join(folder, `${name}.html`), 'utf8').trimEnd();
    return withParts(part).replace(/^/gm, indent);
  });
}
