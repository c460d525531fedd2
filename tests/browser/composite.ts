/** Shared helpers for the tests of the composite editor. */

import type { Browser, Page } from '@playwright/test';
import type { RaconteurComposite } from '../../web/composite/element.js';
import { watched } from './stage.js';

/** Makes a resting face render as simply as a changing one: with software rendering a full image takes seconds. */
export async function drawSimply(page: Page): Promise<void> {
  await page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => {
    e.quality = 'lowest';
  });
}

/** Opens the editor's page with its features, with simple rendering. */
export async function open(page: Page, width = 1280, height = 900): Promise<void> {
  await page.emulateMedia({ reducedMotion: 'reduce' });
  await page.setViewportSize({ width, height });
  await page.goto('/composite/');
  await drawSimply(page);
  await page.locator('raconteur-composite').evaluate((e: RaconteurComposite) => e.ready);
  await page.getByRole('tab', { name: 'Features' }).click();
}

/** One visit shared by several tests, each with a new history: opening the editor takes longer than the tests. */
export class Visit {
  #start: unknown;

  private constructor(
    readonly page: Page,
    private readonly expectDeclared: () => void,
  ) {}

  /** Opens the editor for a spec, named by its file. */
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

  /** Resets the editor as if just opened, except for choices outside the history. */
  async anew(): Promise<void> {
    await this.page.locator('raconteur-composite').evaluate(async (e: RaconteurComposite, start) => await e.open(start), this.#start);
    await this.page.getByRole('tab', { name: 'Features' }).click();
  }
}
