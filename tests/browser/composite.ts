/** What the tests of the composite editor have in common. */

import type { Browser, Page } from '@playwright/test';
import type { RaconteurComposite } from '../../web/composite/element.js';
import { watched } from './stage.js';

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

  private constructor(
    readonly page: Page,
    private readonly expectDeclared: () => void,
  ) {}

  /** For a spec, by its file. */
  static async begin(browser: Browser, file: string, width?: number, height?: number): Promise<Visit> {
    const context = await browser.newContext();
    const expectDeclared = watched(context, file);
    const visit = new Visit(await context.newPage(), expectDeclared);
    await open(visit.page, width, height);
    visit.#start = await visit.page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => e.save());
    return visit;
  }

  async end(): Promise<void> {
    this.expectDeclared();
    await this.page.context().close();
  }

  /** As if the editor had just been opened, but for what is chosen outside the history. */
  async anew(): Promise<void> {
    await this.page.locator('raconteur-composite').evaluate(async (e: RaconteurComposite, start) => await e.open(start), this.#start);
    await this.page.getByRole('tab', { name: 'Features' }).click();
  }
}
