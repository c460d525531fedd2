/** What the tests of the composite editor have in common. */

import type { Page } from '@playwright/test';
import type { RaconteurComposite } from '../../web/composite/element.js';

/** A face at rest is drawn as simply as one that changes: where a processor draws, another picture takes seconds. */
export async function drawSimply(page: Page): Promise<void> {
  await page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => {
    e.quality = 'lowest';
  });
}
