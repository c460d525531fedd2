/** Texts and numbers as the formats of answers have them. */

/** What parts of an answer stand between. */
export const BETWEEN = '[,]';

/**
 * A learner's or an author's text within an answer, at most so many characters (UTF-16 units) long: on one line, without delimiters of
 * the formats, and without a `{` at its start, where a language is looked for. No character is cut in two.
 */
export function plain(text: string, most: number): string {
  // What is far beyond the limit need not be looked through.
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

/** A number without an exponent; undefined where it is none, or is too large for the formats. */
export function decimal(number: number): string | undefined {
  if (!(Math.abs(number) < MAX_NUMBER)) return undefined;
  const text = String(number);
  if (!text.includes('e') && (text.split('.')[1]?.length ?? 0) <= MAX_DECIMALS) return text;
  const digits = number.toFixed(MAX_DECIMALS).replace(/\.?0+$/, '');
  return digits === '-0' ? '0' : digits;
}
