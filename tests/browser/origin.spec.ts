/** The script of one server on the page of another. */

import type { RaconteurPlayer } from '../../web/element/element.js';
import { serveElsewhere } from './elsewhere.js';
import { story } from './fixture.js';
import { expect, ready, test } from './stage.js';

test('a script from another server finds its figures, its code and its animations there', async ({ stage, page }) => {
  const { origin, asked, close } = await serveElsewhere();
  try {
    await page.context().grantPermissions(['local-network-access']);
    await page.route('**/elsewhere/**', (route) => {
      const { pathname } = new URL(route.request().url());
      if (pathname.endsWith('.eml')) return route.fulfill({ body: story("<voice-text time='0'>Hello.</voice-text>") });
      if (!pathname.endsWith('/')) return route.fulfill({ status: 404 });
      return route.fulfill({
        contentType: 'text/html',
        body: `<!doctype html><html lang="en"><meta charset="utf-8"><title>Test</title><script type="module" src="${origin}/player/raconteur-player.js"></script>
          <body><raconteur-player src="story.eml" backend="${stage.backend}" quality="lowest" loading="eager"></raconteur-player>
          <raconteur-player id="other" assets="mine/"></raconteur-player></body></html>`,
      });
    });
    await page.goto('/elsewhere/page/');
    await ready(stage.player);
    expect(await stage.player.evaluate((p: RaconteurPlayer) => [p.assets, p.currentFigure])).toEqual([`${origin}/player/assets/`, 'sofia']);
    expect(asked).toContain('/player/assets/figures/sofia.glb');
    expect(asked.filter((path) => !path.startsWith('/player/'))).toEqual([]);
    // URLs in the page still resolve relative to the page.
    const wanted = page.waitForRequest('**/elsewhere/page/mine/figures/sofia.glb');
    await page.locator('#other').evaluate((p: RaconteurPlayer) => void p.rehearse('<eml><body><null time="1"/></body></eml>').catch(() => undefined));
    await wanted;
  } finally {
    close();
  }
});
