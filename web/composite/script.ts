/** What the figure is told: to be still, or to say a sentence. */

import { tag } from '../speech/markup.js';

/** How long a face that says nothing is shown, seconds; then it begins again. */
const LENGTH_SECS = 600;

const whole = (clauses: readonly string[]): string => `${tag('eml', { name: 'composite' }, [tag('body', {}, [...clauses])])}\n`;

export const still = whole([tag('null', { time: LENGTH_SECS })]);

const escapeText = (text: string): string => text.replace(/&/g, '&amp;').replace(/</g, '&lt;');

/** A script that says a sentence. */
export const saying = (text: string): string => whole([tag('voice-text', { time: 0.4 }, [escapeText(text), tag('tm', { name: 'said' })]), tag('null', { time: 'said+1s' })]);
