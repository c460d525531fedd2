import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import type { EnvironmentExpression } from '../element/base/types.js';
import { BANDS, bandOf, rulesOf, formatNumber } from '../pages/expression/rules.js';
import { beginning, settingOf } from '../pages/expression/state.js';
import { BAD, feltAt, GOOD, RAYS, rayOf, spotOf, stepFrom } from '../pages/expression/types.js';
import { write } from '../pages/expression/write.js';

const source = readFileSync(join(import.meta.dirname, '../../crate/stage/src/emotion.rs'), 'utf8');

const ANGER: EnvironmentExpression = {
  emotion: 'anger',
  potential: 3.5,
  intensity: 3.5,
  shot: 'closeUp',
  angle: 'low',
  color: [255, 0, 0],
  attenuation: 0.35,
  brightness: 0.65 / 0.75,
  valence: -2.1,
  arousal: 1.2,
  music: ['negative-heavy.opus', 'negative-heavy-rise.opus'],
};
const ALL = { camera: true, light: true, music: true };
const texts = (expressed: EnvironmentExpression, channels = ALL): readonly string[] =>
  rulesOf(expressed, channels).map(({ text, source }) => (source === '' ? text : `${text} (${source})`));

describe('the rules that fire', () => {
  it('are those of anger', () => {
    expect(texts(ANGER)).toEqual([
      'Anger, potential 3.5, intensity 3.5 (3.5.4)',
      'Anger → low angle (3.5.4.1, rule 1)',
      'Potential 3.5 in [2.5; 4.5) → close-up (3.5.4.1, rule 5)',
      'Anger → red key light (table 3.2)',
      'Negative: attenuation max(0.25, 3.5/10) = 0.35 → 87 % as bright (equation 3.2)',
      'Mood −2.1 (below −1, bad), arousal 1.2 (above 0.6, active) → negative-heavy, with its livelier voices (3.5.4.3)',
    ]);
    expect(rulesOf(ANGER, ALL).find((rule) => rule.color !== undefined)?.color).toBe('rgb(255 0 0)');
  });

  it('are others for what is good, and for fear', () => {
    const hope: EnvironmentExpression = {
      ...ANGER,
      emotion: 'hope',
      angle: 'eye',
      potential: 7,
      intensity: 7,
      color: [255, 255, 200],
      attenuation: 0.3,
      brightness: 1.4,
      valence: 0.4,
      arousal: 0.1,
    };
    expect(texts({ ...hope, music: ['neutral.opus'] })).toEqual([
      'Hope, potential 7.0, intensity 7.0 (3.5.4)',
      'Hope has no angle of its own → eye height',
      'Potential 7.0 from 4.5 on → extreme close-up (3.5.4.1, rule 6)',
      'Hope → bright yellow key light (table 3.2)',
      'Positive: attenuation min(0.5, 1 − 7.0/10) = 0.30 → 140 % as bright (equation 3.1)',
      'Mood 0.4 (within ±1, neutral), arousal 0.1 (not above 0.6, calm) → neutral (3.5.4.3)',
    ]);
    expect(texts({ ...ANGER, emotion: 'fear', angle: 'high' })).toContain('Fear → high angle (3.5.4.1, rule 2)');
    expect(texts({ ...ANGER, color: [1, 2, 3], music: [] }).join()).toMatch(/rgb\(1 2 3\) key light.*→ silence/);
  });

  it('are silent where a channel is off and where nothing is felt', () => {
    const without = rulesOf(ANGER, { camera: false, light: false, music: false });
    expect(without.map(({ channel }) => channel)).toEqual(['feeling', 'camera', 'light', 'music']);
    expect(without.slice(1).every(({ text, source }) => text.startsWith('Off') && source === '')).toBe(true);
    for (const nothing of [
      { ...ANGER, emotion: 'neutral', potential: 0 },
      { ...ANGER, potential: 0 },
    ]) {
      const rules = rulesOf(nothing, ALL);
      expect(rules[0]?.text).toBe('No emotion: no rule applies');
      expect(rules.every((rule) => rule.source === '')).toBe(true);
    }
  });

  it('change the shot at the potentials of the engine', () => {
    const bounds = [...source.matchAll(/p if p < ([\d.]+) => Shot::(\w+)/g)].map(([, bound, shot]) => [Number(bound), shot] as const);
    expect(BANDS.slice(1).map(({ from }) => from)).toEqual(bounds.map(([bound]) => bound));
    expect([0, 1.4, 1.5, 2.5, 4.4, 4.5, 10].map((p) => bandOf(p).shot)).toEqual(['full', 'full', 'medium', 'closeUp', 'closeUp', 'extremeCloseUp', 'extremeCloseUp']);
  });

  it('have numbers for people', () => {
    expect([formatNumber(-2.14), formatNumber(-0.01), formatNumber(3), formatNumber(0.355, 2)]).toEqual(['−2.1', '0.0', '3.0', formatNumber(0.355, 2)]);
  });
});

describe('the disc of types', () => {
  it('has the types of the engine, good and bad', () => {
    for (const [names, valence] of [
      [GOOD, 'Positive'],
      [BAD, 'Negative'],
    ] as const) {
      const own = [...source.matchAll(new RegExp(`emotion\\("([\\w-]+)", ${valence}`, 'g'))].map(([, name]) => name);
      expect([...names].sort()).toEqual(own.sort());
    }
  });

  it('gives each of them back at its place', () => {
    expect(RAYS.length).toBe(GOOD.length + BAD.length);
    for (const ray of RAYS) for (const potential of [0.1, 2.5, 10]) expect(feltAt(spotOf(ray, potential / 10))).toEqual({ emotion: ray.name, potential });
    expect(feltAt({ x: 0, y: 0 })).toEqual({ emotion: 'neutral', potential: 0 });
    expect(feltAt({ x: 5, y: -1 }).potential).toBe(10);
    // The most active type of a side is uppermost.
    expect(rayOf('hate')?.rise).toBeGreaterThan(rayOf('fears-confirmed')?.rise ?? 0);
    expect(rayOf('neutral')).toBeUndefined();
  });

  it('is walked by keys, to the rim and through the middle', () => {
    const love = { emotion: 'love', potential: 1 } as const;
    expect(stepFrom(love, 5, 0)).toEqual({ emotion: 'love', potential: 1.5 });
    const other = stepFrom(love, -15, 0);
    expect(BAD).toContain(other.emotion);
    expect(other.potential).toBe(0.5);
    expect(stepFrom(other, -5, 0)).toEqual({ ...other, potential: 1 });
    const seen = new Set<string>();
    let felt = stepFrom({ emotion: 'neutral', potential: 0 }, 1, 0);
    for (let i = 0; i < 12; i++) felt = stepFrom(felt, 0, 1);
    for (let i = 0; i < 14; i++) {
      seen.add(felt.emotion);
      felt = stepFrom(felt, 0, -5);
    }
    expect([...seen].sort()).toEqual([...GOOD].sort());
    expect(stepFrom({ emotion: 'neutral', potential: 0 }, 0, 1)).toEqual({ emotion: 'neutral', potential: 0 });
  });
});

describe('the text', () => {
  it('holds what is chosen', () => {
    const eml = write({ emotion: 'anger', potential: 3.5, camera: true, light: false, music: true, set: 'night', thesis: false });
    expect(eml).toContain('<r:environment camera="true" light="false" music="true" set="night"/>');
    const strict = write({ emotion: 'anger', potential: 3.5, camera: true, light: true, music: true, set: 'night', thesis: true });
    expect(strict).toContain('set="night" fidelity="thesis"/>');
    expect(eml).toContain('<r:emotion time="0" type="anger" potential="3.5" duration="24"/>');
    expect(write({ ...beginning().a, emotion: 'neutral' })).not.toContain('r:emotion');
  });

  it('has for the second setting the first one by its face alone, until it is another', () => {
    const state = beginning();
    expect(settingOf(state, 'b')).toEqual({ ...state.a, camera: false, light: false, music: false });
    state.b = { ...state.a, set: 'garden' };
    expect(settingOf(state, 'b').set).toBe('garden');
    expect(state.a.set).toBe('curtain');
  });
});
