/** Linear colours as browsers write them. */

type Linear = readonly [number, number, number];

const toSrgb = (x: number): number => (x <= 0.0031308 ? 12.92 * x : 1.055 * x ** (1 / 2.4) - 0.055);
const toLinear = (x: number): number => (x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4);

/** Returns a linear colour as `#rrggbb`. */
export function hexOf(rgb: Linear): string {
  const part = (x: number): string =>
    Math.round(255 * Math.min(1, Math.max(0, toSrgb(x))))
      .toString(16)
      .padStart(2, '0');
  return `#${rgb.map(part).join('')}`;
}

/** Returns the linear colour of `#rrggbb`; black for other text. */
export function linearOf(hex: string): Linear {
  const parts = /^#([\da-f]{2})([\da-f]{2})([\da-f]{2})$/i.exec(hex)?.slice(1) ?? [];
  const [r = 0, g = 0, b = 0] = parts.map((part) => Number(toLinear(Number.parseInt(part, 16) / 255).toFixed(4)));
  return [r, g, b];
}
