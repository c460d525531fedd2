/**
 * Line-break positions in a text: after a sentence, at a pause, at a comma, before a word that begins a phrase; never after one that depends on the next. The
 * word lists cover the supported languages; for others punctuation and pauses decide.
 */

import type { Word } from '../base/types.js';

/** Quality of a break after a word, best first. */
export enum BreakStrength {
  Sentence,
  /** The speaker stops: the end of a line of verse. */
  Pause,
  Comma,
  /** The next word begins a phrase. */
  Phrase,
  Any,
  /** The word belongs to the next one. */
  Bound,
}

/** A sentence ends with the word. */
const ENDS = /[.!?…]["'”’)]*$/;
/** Punctuation at the end of a sentence part. */
const PAUSES = /[,;:–—]["'”’)]*$/;
const CAPITAL = /^[^\p{L}]?\p{Lu}/u;
/** Maximum length of trailing punctuation: earlier characters need not be examined. */
const TAIL = 16;
/** Maximum length of the words in the lists below. */
const MAX_WORD_LENGTH = 16;
/** Silence perceived as a stop, seconds: without punctuation, and at a comma, where a shorter pause is usual. */
const STOP_SECS = { bare: 0.18, comma: 0.32 } as const;

/** Begin phrases: conjunctions, relative words, prepositions. */
const STARTS: Readonly<Record<string, ReadonlySet<string>>> = {
  en: set(
    'and or but nor so yet for that which who whom whose where when while because if as than then with without from into onto over under through across until till before after about between among against to in on at by',
  ),
  pt: set('e ou mas nem que quem onde quando enquanto porque se como com sem de do da dos das em no na nos nas por pelo pela para até entre sobre sob contra desde após'),
  de: set(
    'und oder aber denn sondern dass ob weil wenn als wie wo der die das mit ohne von vom aus bei zu zum zur nach in im an am auf über unter durch für gegen zwischen bis seit',
  ),
};

/** Words that depend on the next one: articles, prepositions, possessives, auxiliaries, negations. */
const LEANS: Readonly<Record<string, ReadonlySet<string>>> = {
  en: set(
    'a an the my your his her its our their this that these those no not of to in on at by for with without from into onto over under through and or but as than very so too is are was were be been has have had will would can could shall should may might must do does did i he she it we they who which every each some any',
  ),
  pt: set(
    'o a os as um uma uns umas meu minha teu tua seu sua nosso nossa este esta esse essa aquele aquela de do da dos das em no na nos nas por pelo pela para com sem e ou mas que não nunca mais muito tão é era foi são há se já eu ele ela nós eles elas cada todo toda',
  ),
  de: set(
    'der die das den dem des ein eine einen einem einer eines mein dein sein ihr unser kein keine dieser diese dieses von vom zu zum zur in im an am auf aus bei mit nach für und oder aber als wie sehr so nicht ist war sind hat hatte wird ich er sie es wir jeder jede jedes',
  ),
};

/** Articles after which a comma mostly parts two adjectives of one noun: a fine, round cabbage. */
const OPENS: Readonly<Record<string, ReadonlySet<string>>> = {
  en: set('a an my your his her its our their'),
  pt: set('um uma'),
  de: set('ein eine einen einem einer eines mein dein sein ihr unser'),
};

function set(words: string): ReadonlySet<string> {
  return new Set(words.split(' '));
}

/** Returns the break after each word but the last. `texts` are those of the words; `language` is a BCP 47 tag. */
export function breaksOf(words: readonly Word[], texts: readonly string[], language: string): Uint8Array {
  const own = language.toLowerCase().split('-')[0] ?? '';
  const [starts, leans, opens] = [STARTS[own], LEANS[own], OPENS[own]];
  const leaning = (bare: string) => (leans?.has(bare) || starts?.has(bare)) ?? false;
  const breaks = new Uint8Array(Math.max(0, words.length - 1));
  let [before, bare] = ['', bareOf(texts[0] ?? '')];
  for (let i = 0; i < breaks.length; i++) {
    const tail = (texts[i] ?? '').slice(-TAIL);
    const [follows, next] = [texts[i + 1] ?? '', bareOf(texts[i + 1] ?? '')];
    const silence = (words[i + 1]?.startSecs ?? 0) - (words[i]?.endSecs ?? 0);
    const parted = PAUSES.test(tail);
    // A small word with a capital, and no sentence or title: a line of verse begins.
    const isVerse = next !== 'i' && leaning(next) && CAPITAL.test(follows) && !CAPITAL.test(texts[i] ?? '');
    if (ENDS.test(tail)) breaks[i] = BreakStrength.Sentence;
    else if (silence >= (parted ? STOP_SECS.comma : STOP_SECS.bare) || isVerse) breaks[i] = BreakStrength.Pause;
    else if (parted) breaks[i] = opens?.has(before) && !starts?.has(next) ? BreakStrength.Any : BreakStrength.Comma;
    else if (leaning(bare)) breaks[i] = BreakStrength.Bound;
    else breaks[i] = starts?.has(next) ? BreakStrength.Phrase : BreakStrength.Any;
    [before, bare] = [bare, next];
  }
  return breaks;
}

/** Returns a word without surrounding signs, in lower case; empty for long ones. */
function bareOf(text: string): string {
  return text.length > MAX_WORD_LENGTH ? '' : text.toLowerCase().replace(/^[^\p{L}]+|[^\p{L}]+$/gu, '');
}
