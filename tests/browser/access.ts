/** Accessibility checks for every page: no barriers and no sideways scroll, in light and dark schemes, on a phone and on a desktop. */

import { AxeBuilder } from '@axe-core/playwright';
import type { Page } from '@playwright/test';
import { isLong } from '../../web/test/tier.js';
import { expect } from './stage.js';

const ALL_LOOKS = (['light', 'dark'] as const).flatMap((colorScheme) => [
  { colorScheme, device: 'phone', width: 390, height: 844 },
  { colorScheme, device: 'desktop', width: 1440, height: 900 },
]);

/** Combinations of colour scheme and device to test; the gate uses each colour scheme and each width once. */
export const LOOKS = ALL_LOOKS.filter(({ colorScheme, device }) => isLong || (colorScheme === 'light') === (device === 'phone'));

/** Applies a combination to a page. */
export async function lookAt(page: Page, { colorScheme, width, height }: (typeof LOOKS)[number]): Promise<void> {
  await page.emulateMedia({ colorScheme });
  await page.setViewportSize({ width, height });
}

/** Returns the parts of a page to test in one combination; in the gate each part is tested in one of them. */
export const partsIn = (look: (typeof LOOKS)[number], parts: readonly string[]): readonly string[] => parts.filter((_, i) => isLong || i % LOOKS.length === LOOKS.indexOf(look));

/** Checks the page in its present state; `part` names the open part. */
export async function expectNoBarriers(page: Page, part = 'page'): Promise<void> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map((v) => `${part}: ${v.id}: ${v.nodes.map((n) => n.target.join(' ')).join('; ')}`)).toEqual([]);
  expect(await page.evaluate(() => document.documentElement.scrollWidth)).toBe(page.viewportSize()?.width);
}
