/** Test of the course created by `raconteur new --course`: it plays, asks its questions, and reaches its end. */

import { readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';
import type { RaconteurPlayer } from '../../web/element/element.js';
import { expect, test } from './stage.js';

const FOLDER = join(import.meta.dirname, '../../crate/cli/course');
const files = Object.fromEntries(
  readdirSync(FOLDER, { recursive: true, encoding: 'utf8' })
    .filter((name) => name.includes('.'))
    .map((name) => [name, readFileSync(join(FOLDER, name))]),
);

test('the first course is played to its end, whatever is drawn', async ({ stage }) => {
  test.setTimeout(240_000);
  await stage.open('<main><h1>A page</h1><raconteur-player src="story.eml" quality="lowest" loading="eager" label="The pond" controls></raconteur-player></main>', files);
  await stage.ready();
  expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.questions.length, p.score.most])).toEqual([9, 11]);
  const { kinds, score } = await stage.player.evaluate(async (p: RaconteurPlayer) => {
    const kinds: string[] = [];
    p.addEventListener('question', ({ detail: { kind, options } }) => {
      kinds.push(kind);
      const right = kind === 'order' || kind === 'match' ? options : options.filter(({ isRight }) => isRight);
      const names = (right.length > 0 ? right : options.slice(0, 1)).map(({ name }) => name);
      const written: { readonly [kind: string]: readonly string[] } = { gap: options.map(({ accepts }) => accepts?.[0] ?? ''), number: ['4'], text: ['In the mud.'] };
      // As soon as the form is there.
      void p.updateComplete.then(() => p.answer(...(written[kind] ?? names)));
    });
    const isOver = new Promise((over) => p.addEventListener('ended', over, { once: true }));
    p.muted = true;
    p.playbackRate = 2;
    await p.play();
    await isOver;
    return { kinds, score: p.score };
  });
  expect(score).toEqual({ points: 11, most: 11 });
  expect(kinds).toHaveLength(9);
  expect(['choice', 'several', 'order', 'match', 'point', 'text'].filter((kind) => !kinds.includes(kind))).toEqual([]);
});
