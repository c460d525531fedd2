/** Tests of the element's default size, compared with a video in the same place. */

import { expect, test } from './stage.js';

/** Layout contexts of an element: the style of its container, and its own. */
const PLACES: { [name: string]: readonly [around: string, own: string] } = {
  'a flex row': ['display: flex', ''],
  'a flex row, at its start': ['display: flex; align-items: flex-start; width: 700px', ''],
  'a flex row that is too narrow': ['display: flex; width: 200px', ''],
  'a flex column, at its start': ['display: flex; flex-direction: column; align-items: flex-start', ''],
  'a grid, at its start': ['display: grid; justify-items: start; width: 700px', ''],
  'a grid with columns of content': ['display: inline-grid; grid-template-columns: auto auto', ''],
  'a float': ['', 'float: left'],
  'a table': ['display: table', ''],
  'a cell of a table': ['display: table-cell', ''],
  'a cell of a narrow table': ['display: table-cell; width: 100px', ''],
  'an inline block': ['', 'display: inline-block'],
  'an absolute place': ['position: relative; height: 500px', 'position: absolute; left: 0; top: 0'],
  'a box as wide as its content': ['width: fit-content', ''],
  'a block as wide as its content': ['', 'display: block; width: fit-content'],
  'a given width': ['display: flex; align-items: flex-start', 'width: 480px'],
  'a small width': ['display: flex; align-items: flex-start', 'width: 90px'],
  'a share of the width': ['width: 640px', 'width: 50%'],
  'a greatest width': ['display: flex; align-items: flex-start', 'max-width: 160px'],
};

test('in every layout it is as large as a video would be', async ({ stage, page }) => {
  // The policy of the page allows no style but that of a file.
  const rules = Object.values(PLACES)
    .map(([around, own], i) => `.around${i} { ${around} } .own${i} { ${own} }`)
    .join('\n');
  await stage.open('<main></main>', { 'test.css': `body { margin: 0; width: 900px }\n${rules}` });
  await page.waitForFunction(() => customElements.get('raconteur-player') !== undefined);
  for (const [i, name] of Object.keys(PLACES).entries()) {
    const sizes = await page.evaluate(
      (at) =>
        ['video', 'raconteur-player'].map((tag) => {
          const around = document.createElement('div');
          around.className = `around${at}`;
          const media = document.createElement(tag);
          media.className = `own${at}`;
          around.append(media);
          document.querySelector('main')?.replaceChildren(around);
          const { width, height } = media.getBoundingClientRect();
          return { width, height };
        }),
      i,
    );
    const [video = { width: 0, height: 0 }, ours] = sizes;
    // A video without a frame is 300 by 150 and has no aspect ratio yet; the player is 16 by 9.
    const [width, height] = [video.width, (video.width * 9) / 16];
    expect(ours, name).toEqual({ width: expect.closeTo(width, 0), height: expect.closeTo(height, 0) });
  }
});

test('in a column of text and in a grid it is as wide as they are', async ({ stage, page }) => {
  const css = 'body { margin: 0 } main, article { width: 400px } main { display: grid }';
  await stage.open('<article><raconteur-player></raconteur-player></article><main><raconteur-player></raconteur-player></main>', { 'test.css': css });
  await page.waitForFunction(() => customElements.get('raconteur-player') !== undefined);
  for (const player of await page.locator('raconteur-player').all()) {
    const { width, height } = (await player.boundingBox()) ?? { width: 0, height: 0 };
    expect([width, height]).toEqual([400, 225]);
  }
});
