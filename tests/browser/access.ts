/** What every page is held to: no barriers and no sideways scroll, by day and by night, on a phone and on a desktop. */

import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { isLong } from '../../web/test/tier.js';
import { expect } from './stage.js';

const ALL_LOOKS = (['light', 'dark'] as const).flatMap((colorScheme) => [
  { colorScheme, device: 'phone', width: 390, height: 844 },
  { colorScheme, device: 'desktop', width: 1440, height: 900 },
]);

/** How a page is looked at; in the gate each colour scheme and each width once. */
export const LOOKS = ALL_LOOKS.filter(({ colorScheme, device }) => isLong || (colorScheme === 'light') === (device === 'phone'));

/** Looks at a page as it stands then. */
export async function lookAt(page: Page, { colorScheme, width, height }: (typeof LOOKS)[number]): Promise<void> {
  await page.emulateMedia({ colorScheme });
  await page.setViewportSize({ width, height });
}

/** The parts of a page that are looked at in one way; in the gate each part in one of them. */
export const partsIn = (look: (typeof LOOKS)[number], parts: readonly string[]): readonly string[] => parts.filter((_, i) => isLong || i % LOOKS.length === LOOKS.indexOf(look));

/** Checks the page as it is now; `part` says which part of it is open. */
export async function expectNoBarriers(page: Page, part = 'page'): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map((v) => `${part}: ${v.id}: ${v.nodes.map((n) => n.target.join(' ')).join('; ')}`)).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(page.viewportSize()?.width);
}
