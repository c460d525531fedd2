/** Texts and numbers as the formats of answers have them. */

/** Delimiter between parts of an answer. */
export const BETWEEN = '[,]';

/**
 * Returns a learner's or an author's text for use in an answer, with at most a number of characters (UTF-16 units): on one line, without delimiters of the
 * formats, and without a `{` at its start, where a language is expected. No character is split.
 */
export function plain(text: string, most: number): string {
  // Text far beyond the limit needs no processing.
  const line = text
    .slice(0, 2 * most)
    .replaceAll(/\p{Surrogate}/gu, '\uFFFD')
    .replaceAll(/[\p{Cc}\u2028\u2029]+/gu, ' ')
    .replaceAll(/\[([,.:])\]/g, '[ $1 ]')
    .trim()
    .replace(/^\{/, ' {');
  return line
    .slice(0, most)
    .replace(/[\uD800-\uDBFF]$/, '')
    .trimEnd();
}

/** The formats have ten digits before the point and eighteen after it. */
const MAX_NUMBER = 1e10;
const MAX_DECIMALS = 18;

/** Formats a number without an exponent; returns undefined if it is not finite, or too large for the formats. */
export function decimal(number: number): string | undefined {
  if (!(Math.abs(number) < MAX_NUMBER)) return undefined;
  const text = String(number);
  if (!text.includes('e') && (text.split('.')[1]?.length ?? 0) <= MAX_DECIMALS) return text;
  const digits = number.toFixed(MAX_DECIMALS).replace(/\.?0+$/, '');
  return digits === '-0' ? '0' : digits;
}
