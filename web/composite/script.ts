/** Scripts of the figure: being still, or speaking a sentence. */

import { tag } from '../speech/markup.js';

/** Duration for which a silent face is shown, seconds; then it restarts. */
const LENGTH_SECS = 600;

const whole = (clauses: readonly string[]): string => `${tag('eml', { name: 'composite' }, [tag('body', {}, [...clauses])])}\n`;

export const still = whole([tag('null', { time: LENGTH_SECS })]);

/** Returns the script of a silent face, like `still`, in a set instead of before the curtain. */
export const stillIn = (set: string): string =>
  `${tag('eml', { name: 'composite', 'xmlns:r': 'urn:raconteur:eml:1' }, [tag('head', {}, [tag('r:environment', { set, music: 'false' })]), tag('body', {}, [tag('null', { time: LENGTH_SECS })])])}\n`;

const escapeText = (text: string): string => text.replace(/&/g, '&amp;').replace(/</g, '&lt;');

/** Returns a script that speaks a sentence. */
export const saying = (text: string): string => whole([tag('voice-text', { time: 0.4 }, [escapeText(text), tag('tm', { name: 'said' })]), tag('null', { time: 'said+1s' })]);

/**
 * Story time, seconds, at which all motion has come to rest and a segment of the soft-face simulation begins, so another face at this time takes the fewest
 * steps.
 */
export const REST_SECS = 1.6;
