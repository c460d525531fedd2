/** The style of the documentation: textlint reads its Markdown; code, addresses and quotations are exempt. */

import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import { TextlintKernel, type TextlintRuleModule } from '@textlint/kernel';
import markdown from '@textlint/textlint-plugin-markdown';
import sentenceLength from 'textlint-rule-sentence-length';
import { expect, test } from 'vitest';

const root = join(import.meta.dirname, '../..');

/** Longest sentence, characters of its source. */
const MAX_CHARACTERS = 360;

/** Phrases that hide who does what, each with the wanted wording. */
const PHRASES: readonly (readonly [RegExp, string])[] = [
  [/\b(?:is|are|was|were|be|being)\s+(?:waited|looked|asked|cared|spoken|told)\s+(?:for|of|after)\b/gi, 'name the actor: "the player awaits …", "requests …"'],
  [/\b(?:is|are|was|were|be)\s+told\b/gi, '"is reported", "receives"'],
  [/\btells?\s+(?:of|which|whether|what|how)\b/gi, '"reports", "shows", "specifies"'],
  [/\bstands\s+(?:for\s+itself|beside|there|between|over)\b/gi, '"is in", "appears"'],
  [/\b(?:is|are)\s+to\s+be\s+(?:had|found|seen|heard)\b/gi, '"is available"'],
  [/\bbesides?\b(?!\s+the\s+point)/gi, '"in addition to", "next to", "compared with"'],
  [/\b(?:anew|whosoever|lest|nought|yonder|thereof|whereof|therein|thither)\b/gi, 'a plain word'],
  [/\b(?:by|of)\s+itself\b/gi, '"automatically", or leave it out'],
  [/\bso\s+(?:many|long|far|often)\s+(?:seconds|times|words|that)\b/gi, 'say how many'],
  [/\bwhat\s+(?:is|was)\s+(?:said|told|asked|heard|felt|worn|shown|drawn|seen|meant|wanted)\b/gi, 'a noun: "the spoken text", "the image"'],
  [/\b(?:^|, )who\s+(?:asks|wants|looks|reads)\s+/gi, '"users who …"'],
  [/\bno\s+sooner\b|\bonce\s+more\b|\bas\s+good\s+as\b|\bat\s+once\b/gi, '"immediately", "again", "simultaneously"'],
];

const phrases: TextlintRuleModule = ({ Syntax, RuleError, report, getSource, locator }) => ({
  [Syntax.Str](node) {
    const text = getSource(node);
    for (const [pattern, wanted] of PHRASES) {
      for (const { 0: found, index } of text.matchAll(pattern))
        report(node, new RuleError(`“${found}”: write ${wanted}`, { padding: locator.range([index, index + found.length]) }));
    }
  },
});

const kernel = new TextlintKernel();
const check = async (text: string): Promise<string[]> => {
  const { messages } = await kernel.lintText(text, {
    ext: '.md',
    plugins: [{ pluginId: 'markdown', plugin: markdown }],
    rules: [
      { ruleId: 'phrases', rule: phrases },
      { ruleId: 'sentence-length', rule: sentenceLength, options: { max: MAX_CHARACTERS } },
    ],
  });
  return messages.map(({ line, message }) => `${line}: ${message}`);
};

/** Markdown below a folder, by its path from the root. */
function below(folder: string): string[] {
  return readdirSync(join(root, folder), { recursive: true, encoding: 'utf8' })
    .filter((path) => path.endsWith('.md') && !path.includes('node_modules'))
    .map((path) => join(folder, path));
}

const documents = [
  ...readdirSync(root).filter((name) => name.endsWith('.md')),
  ...['docs', 'assets', 'examples', 'packages', 'web/element', 'web/package', 'web/pages', 'crate'].flatMap(below),
];
/** Released sections of the change log, and stories, are as they were. */
const EXEMPT = /virtual-poets|^docs\/glossary\.md$/;

const readable = (path: string): string => {
  const text = readFileSync(join(root, path), 'utf8');
  return path === 'CHANGELOG.md' ? (text.split(/^## (?=0\.)/m)[0] ?? '') : text;
};

test.each(documents.filter((path) => !EXEMPT.test(path)))('%s is plain', async (path) => {
  expect(await check(readable(path))).toEqual([]);
});

test('faults are found', async () => {
  const faults = await check('# Networks\n\nA slow network is waited\nfor. `what is told` is code.\n');
  expect(faults).toHaveLength(1);
});
