/** Tests that the lengths of stories in documents and cards match the player's. */

import { existsSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, ready, test } from './stage.js';

const assets = join(import.meta.dirname, '../../assets');
const read = (path: string): string => readFileSync(join(assets, path), 'utf8');

/** Rows of the table in the library's own document: a story, its seconds, and its gesture keys, if listed. */
const ROWS = [...read('stories/README.md').matchAll(/^\| `([\w/-]+)` \|.*\| (\d+(?:\.\d+)?) s(?:, (\d+) gesture keys| without the poem)? \|$/gm)].map(
  ([, story = '', secs = '', keys]) => ({ story, secs, keys }),
);
const COUNTS: Readonly<Record<string, number>> = { Two: 2, Three: 3, Four: 4, Five: 5, Eight: 8 };

test('the stories last as long as documents and cards say', async ({ stage, page }) => {
  expect(stage.backend).toBe('page');
  test.setTimeout(300_000);
  await page.goto('/');
  const player = page.locator('raconteur-player');
  await ready(player);
  const cards = await page
    .locator('[data-story]')
    .evaluateAll((all) => all.map((e) => ({ story: (e as HTMLElement).dataset['story'] ?? '', text: e.querySelector('small')?.textContent ?? '' })));
  expect(ROWS.map(({ story }) => story).sort()).toEqual(cards.map(({ story }) => story).sort());
  const music = read('music/README.md');
  for (const { story, secs, keys } of ROWS) {
    expect(existsSync(join(assets, 'stories', story, 'story.eml')), story).toBe(true);
    const lasts = await player.evaluate(async (p: RaconteurPlayer, src) => {
      p.src = src;
      await p.load();
      return p.duration;
    }, `assets/stories/${story}/story.eml`);
    const digits = secs.split('.')[1]?.length ?? 0;
    expect(lasts.toFixed(digits), story).toBe(secs);
    // Comments name clauses, too.
    if (keys !== undefined)
      expect(
        read(`stories/${story}/story.eml`)
          .replace(/<!--[\s\S]*?-->/g, '')
          .match(/<gesture-key\b/g),
        story,
      ).toHaveLength(Number(keys));
    const [, word = ''] = /(\w+) minutes/.exec(cards.find((card) => card.story === story)?.text ?? '') ?? [];
    if (word !== '') expect(Math.round(lasts / 60), story).toBe(COUNTS[word]);
    const [, minutes] = new RegExp(`^\\| \`${story}\\.json\`.* (\\d+) minutes.*$`, 'm').exec(music) ?? [];
    if (minutes !== undefined) expect(Math.round(lasts / 60), story).toBe(Number(minutes));
  }
});
