/** What the tests of the composite editor have in common. */

import type { Browser, Page } from '@playwright/test';
import type { RaconteurComposite } from '../../web/composite/element.js';

/** A face at rest is drawn as simply as one that changes: where a processor draws, another picture takes seconds. */
export async function drawSimply(page: Page): Promise<void> {
  await page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => {
    e.quality = 'lowest';
  });
}

/** Opens the editor's page with its features, drawn simply. */
export async function open(page: Page, width = 1280, height = 900): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize({ width, height });
  await page.goto('/composite/');
  await drawSimply(page);
  await page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => e.ready);
  await page.getByRole('tab', { name: 'Features' }).click();
}

/** One visit in which several tests begin with a new history: to open the editor takes longer than to ask it something. */
export class Visit {
  #start: unknown;

  private constructor(readonly page: Page) {}

  static async begin(browser: Browser, width?: number, height?: number): Promise<Visit> {
    const visit = new Visit(await (await browser.newContext()).newPage());
    await open(visit.page, width, height);
    visit.#start = await visit.page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => e.save());
    return visit;
  }

  /** As if the editor had just been opened, but for what is chosen outside the history. */
  async anew(): Promise<void> {
    await this.page.locator('raconteur-composite').evaluate(async (e: RaconteurComposite, start) => await e.open(start), this.#start);
    await this.page.getByRole('tab', { name: 'Features' }).click();
  }
}
