/** Rules by which the environment expresses emotions (GEVH 3.5.4), as sentences about one time. */

import type { EnvironmentExpression } from '../../element/base/types.js';
import type { Channels } from './state.js';
import { BAD, GOOD, STRONGEST } from './types.js';

/** Active rule, or a channel without one. */
export interface Rule {
  readonly channel: 'feeling' | keyof Channels;
  readonly text: string;
  /** Reference in GEVH; empty if there is none. */
  readonly source: string;
  /** The colour that it is about, of CSS. */
  readonly color?: string;
}

/** Camera distance, and the potential from which it applies. */
interface PotentialBand {
  readonly from: number;
  readonly shot: EnvironmentExpression['shot'];
  readonly name: string;
  readonly rule: number;
}

/** GEVH 3.5.4.1, rules 3 to 6: each band without its upper end, as `EmotionType::distance` of `crate/stage` has them. */
export const BANDS: readonly [PotentialBand, ...PotentialBand[]] = [
  { from: 0, shot: 'full', name: 'full shot', rule: 3 },
  { from: 1.5, shot: 'medium', name: 'medium shot', rule: 4 },
  { from: 2.5, shot: 'closeUp', name: 'close-up', rule: 5 },
  { from: 4.5, shot: 'extremeCloseUp', name: 'extreme close-up', rule: 6 },
];

export function bandOf(potential: number): PotentialBand {
  return BANDS.findLast((band) => potential >= band.from) ?? BANDS[0];
}

/** The colours of GEVH table 3.2. */
const COLORS: Readonly<Record<string, string>> = {
  '255,0,0': 'red',
  '200,200,200': 'grey',
  '220,255,0': 'green-yellow',
  '153,153,153': 'dark grey',
  '255,255,255': 'white',
  '255,255,200': 'bright yellow',
  '255,255,0': 'yellow',
};

/** Moods beyond these are good or bad, or active: `crate/stage/src/mood.rs`. */
const MOODY = 1;
const AROUSED = 0.6;

/** Formats a number for people: with a true minus, and without unnecessary digits. */
export const formatNumber = (n: number, digits = 1): string => {
  const text = Math.abs(n).toFixed(digits);
  return n < 0 && Number(text) !== 0 ? `−${text}` : text;
};

const capital = (word: string): string => `${word.charAt(0).toUpperCase()}${word.slice(1)}`;

function angleRule({ emotion, angle }: EnvironmentExpression): Rule {
  const name = capital(emotion);
  if (angle === 'eye') return { channel: 'camera', text: `${name} has no angle of its own → eye height`, source: '' };
  return { channel: 'camera', text: `${name} → ${angle} angle`, source: angle === 'low' ? '3.5.4.1, rule 1' : '3.5.4.1, rule 2' };
}

function shotRule({ potential }: EnvironmentExpression): Rule {
  const { from, name, rule } = bandOf(potential);
  const next = BANDS.find((band) => band.from > potential)?.from;
  const range = next === undefined ? `from ${formatNumber(from)} on` : `in [${formatNumber(from)}; ${formatNumber(next)})`;
  return { channel: 'camera', text: `Potential ${formatNumber(potential)} ${range} → ${name}`, source: `3.5.4.1, rule ${rule}` };
}

function colorRule({ emotion, color }: EnvironmentExpression): Rule {
  const css = `rgb(${color.join(' ')})`;
  return { channel: 'light', text: `${capital(emotion)} → ${COLORS[color.join()] ?? css} key light`, source: 'table 3.2', color: css };
}

function lossRule({ emotion, intensity, attenuation, brightness }: EnvironmentExpression): Rule {
  const isGood = GOOD.some((name) => name === emotion);
  const share = `${formatNumber(intensity)}/${STRONGEST}`;
  const [sense, how, equation] = isGood ? ['Positive', `min(0.5, 1 − ${share})`, '3.1'] : ['Negative', `max(0.25, ${share})`, '3.2'];
  return {
    channel: 'light',
    text: `${sense}: attenuation ${how} = ${formatNumber(attenuation, 2)} → ${formatNumber(100 * brightness, 0)} % as bright`,
    source: `equation ${equation}`,
  };
}

/** Returns the name of the mood, and the bounds that define it. */
function moodOf({ valence, arousal }: EnvironmentExpression): string {
  const tone = valence > MOODY ? `above ${MOODY}, good` : valence < -MOODY ? `below −${MOODY}, bad` : `within ±${MOODY}, neutral`;
  const active = arousal > AROUSED ? `above ${AROUSED}, active` : `not above ${AROUSED}, calm`;
  return `Mood ${formatNumber(valence)} (${tone}), arousal ${formatNumber(arousal)} (${active})`;
}

/** Returns the piece without its folder and extension; the part added by arousal has its own file. */
function pieceOf(music: readonly string[]): string {
  const names = music.map((file) => file.replace(/^.*\/|\.\w+$/g, ''));
  const piece = names.find((name) => !name.endsWith('-rise'));
  if (piece === undefined) return 'silence';
  return names.includes(`${piece}-rise`) ? `${piece}, with its livelier voices` : piece;
}

const off = (channel: keyof Channels, text: string): Rule => ({ channel, text, source: '' });

const OFF: Readonly<Record<keyof Channels, string>> = {
  camera: 'Off: the storyteller’s shot, at eye height',
  light: 'Off: the light of the set',
  music: 'Off: silence',
};

/** Descriptions of each channel without emotion. */
const PLAIN: Readonly<Record<keyof Channels, string>> = {
  camera: 'The storyteller’s shot, at eye height',
  light: 'The light of the set',
  music: 'Silence',
};

/** Returns all rules active at a time. */
export function rulesOf(expressed: EnvironmentExpression, channels: Channels): readonly Rule[] {
  const { emotion, potential } = expressed;
  const isFelt = [...GOOD, ...BAD].some((name) => name === emotion) && potential > 0;
  const feeling: Rule = {
    channel: 'feeling',
    text: isFelt ? `${capital(emotion)}, potential ${formatNumber(potential)}, intensity ${formatNumber(expressed.intensity)}` : 'No emotion: no rule applies',
    source: isFelt ? '3.5.4' : '',
  };
  const of = (channel: keyof Channels, rules: () => readonly Rule[]): readonly Rule[] => {
    if (!channels[channel]) return [off(channel, OFF[channel])];
    return isFelt ? rules() : [off(channel, PLAIN[channel])];
  };
  return [
    feeling,
    ...of('camera', () => [angleRule(expressed), shotRule(expressed)]),
    ...of('light', () => [colorRule(expressed), lossRule(expressed)]),
    ...of('music', () => [{ channel: 'music', text: `${moodOf(expressed)} → ${pieceOf(expressed.music)}`, source: '3.5.4.3' }]),
  ];
}
