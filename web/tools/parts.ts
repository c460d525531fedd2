// Inserts texts shared by several pages of the site, from web/pages/parts.

import { readFileSync } from 'node:fs';
import { join } from 'node:path';

const folder = join(import.meta.dirname, '../pages/parts');

/** Replaces `<!-- part: NAME -->` in a text by the part, with the same indentation; parts may be nested. */
export function withParts(text: string): string {
  return text.replace(/^( *)<!-- part: ([\w-]+) -->$/gm, (_, indent: string, name: string) => {
    const part = readFileSync(join(folder, `${name}.html`), 'utf8').trimEnd();
    return withParts(part).replace(/^/gm, indent);
  });
}
