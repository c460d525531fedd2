/** What the figure is told: to be still, or to say a sentence. */

import { tag } from '../speech/markup.js';

/** How long a face that says nothing is shown, seconds; then it begins again. */
const LENGTH_SECS = 600;

const whole = (clauses: readonly string[]): string => `${tag('eml', { name: 'composite' }, [tag('body', {}, [...clauses])])}\n`;

export const still = whole([tag('null', { time: LENGTH_SECS })]);

/** The same elsewhere than before the curtain. */
export const stillIn = (set: string): string =>
  `${tag('eml', { name: 'composite', 'xmlns:r': 'urn:raconteur:eml:1' }, [tag('head', {}, [tag('r:environment', { set, music: 'false' })]), tag('body', {}, [tag('null', { time: LENGTH_SECS })])])}\n`;

const escapeText = (text: string): string => text.replace(/&/g, '&amp;').replace(/</g, '&lt;');

/** A script that says a sentence. */
export const saying = (text: string): string => whole([tag('voice-text', { time: 0.4 }, [escapeText(text), tag('tm', { name: 'said' })]), tag('null', { time: 'said+1s' })]);

/** A moment of it, seconds: all has come to rest, and a piece of what moves the soft face begins, so that another face at it takes the fewest steps. */
export const REST_SECS = 1.6;
