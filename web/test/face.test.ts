import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { curvesOf, DIRECT_CONTROLS, segmentsOf } from '../element/face/course.js';
import { dominance, liveliest } from '../pages/face/course.js';
import { ALL, MUSCLE_ORDER, MUSCLES, musclesOf, namesOf } from '../pages/face/dials.js';
import { at, inWords, NEUTRAL, OUTLINE, sharesAt, within, WORDS } from '../pages/face/disc.js';
import { ALL_AMOUNTS } from '../pages/face/manner.js';
import { lines, read } from '../pages/face/read.js';
import { beginning, type State } from '../pages/face/state.js';
import { write } from '../pages/face/write.js';

const root = join(import.meta.dirname, '../..');
const source = (path: string): string => readFileSync(join(root, path), 'utf8');

const written = (edit: (state: State) => void): string => {
  const state = beginning();
  edit(state);
  return write(state);
};

/** Evenly spaced points all over the disc, beyond the reach of the words. */
const places = Array.from({ length: 41 * 41 }, (_, i) => ({ evaluation: -100 + 5 * (i % 41), activation: -100 + 5 * Math.floor(i / 41) }));

describe('the way of expressions', () => {
  const line = (head: string) => ({ kind: 'story', line: { label: 'a', markup: '<voice-text>a</voice-text>', before: [], head } }) as const;
  it.each(['', '<head/>', '<head>\n  <null/>\n</head>', '<head><r:performer figure="nuno"/></head>'])('stands in a head that was %j', (head) => {
    const text = written((s) => Object.assign(s, { way: 'text', speech: line(head) }));
    expect(text.match(/<head/g)).toHaveLength(1);
    expect(text).toMatch(/<head>[\s\S]*<r:performer [^>]*expressions="text"[\s\S]*<\/head>/);
    expect(text).toContain('xmlns:r=');
    expect(written((s) => Object.assign(s, { speech: line(head) }))).not.toContain('expressions');
  });
});

describe('the manner of speech', () => {
  it('has the ranges and usual amounts that the player has', () => {
    const rust = source('crate/actor/src/nonverbal/manner.rs');
    const usual = Object.fromEntries([...rust.matchAll(/^ {12}(\w+): ([\d.]+),$/gm)].map(([, name = '', value]) => [name, Number(value)]));
    const schema = source('crate/eml/src/schema/performer.rs').replace(/\s+/g, ' ');
    const fields = source('crate/eml/src/clauses/environment.rs');
    for (const { name, least, most, usual: own } of ALL_AMOUNTS) {
      const [, field = ''] = new RegExp(`(\\w+): Option<f64> = "${name}"`).exec(fields) ?? [];
      expect(own, name).toBe(usual[field]);
      const [, from, to] = new RegExp(`between\\( ?"${name}", ([\\d.]+), ([\\d.]+),`).exec(schema) ?? [];
      expect(least, name).toBe(Number(from));
      expect(most, name).toBeLessThanOrEqual(Number(to));
    }
    expect(ALL_AMOUNTS).toHaveLength(Object.keys(usual).length);
  });

  it('is written where it is not usual, and read again', () => {
    const manner = { frowns: 0.8, thinkingPause: 1.2 };
    const text = written((s) => Object.assign(s, { manner }));
    expect(text).toMatch(/<r:performer frowns="0.8" thinkingPause="1.2"\/>/);
    expect(read(text).manner).toEqual(manner);
    expect(read(written(() => undefined)).manner).toEqual({});
  });
});

describe('the disc of emotions', () => {
  it('has the words and numbers that the player has', () => {
    const table = /WORDS: \[[^=]*= \[([\s\S]*?)\n\];/.exec(source('crate/speech/src/emotion.rs'))?.[1] ?? '';
    const rows = [...table.matchAll(/\("([\w-]+)", \[([-\d., ]+)\]\)/g)].map(([, word, numbers]) => [word, (numbers ?? '').split(', ').map(Number)] as const);
    expect(rows.length).toBe(WORDS.reduce((sum, place) => sum + 1 + place.also.length, 0));
    expect(rows.length).toBeGreaterThan(20);
    for (const [word, [activation, evaluation, power]] of rows) {
      const own = WORDS.find((w) => w.word === word || w.also.includes(word ?? ''));
      expect(own, word).toMatchObject({ activation, evaluation, power });
    }
  });

  it('says every place within its outline exactly, by two words at most', () => {
    for (const place of places) {
      const inside = within(place);
      for (const power of [-60, 0, 60]) {
        const shares = sharesAt({ ...inside, power });
        expect(shares.length).toBeLessThanOrEqual(2);
        expect(shares.reduce((sum, s) => sum + s.value, 0)).toBeLessThanOrEqual(1.0001);
        const there = at(shares);
        // A contribution below half a percent of a word is omitted.
        expect(Math.hypot(there.evaluation - inside.evaluation, there.activation - inside.activation)).toBeLessThan(1);
      }
    }
  });

  it('brings a place outside to the nearest of the outline, and leaves one inside alone', () => {
    expect(within({ evaluation: 5, activation: 12 })).toEqual({ evaluation: 5, activation: 12 });
    expect(within({ evaluation: 0, activation: 140 })).toEqual({ evaluation: 0, activation: 100 });
    for (const place of places) {
      const near = within(place);
      const far = Math.hypot(near.evaluation - place.evaluation, near.activation - place.activation);
      for (const [e, a] of OUTLINE) expect(far).toBeLessThanOrEqual(Math.hypot(e - place.evaluation, a - place.activation) + 1e-9);
      const again = within(near);
      expect(Math.hypot(again.evaluation - near.evaluation, again.activation - near.activation)).toBeLessThan(1e-6);
    }
  });

  it('chooses by power between words of one direction, and a word at its place alone', () => {
    for (const word of WORDS) expect(sharesAt(word), word.word).toEqual([{ word, value: 1 }]);
    const between = { activation: 10, evaluation: -25 };
    expect(at(sharesAt({ ...between, power: -79 })).power).toBeLessThan(-50);
    expect(at(sharesAt({ ...between, power: 40 })).power).toBeGreaterThan(0);
    expect(sharesAt({ ...NEUTRAL, power: 50 })).toEqual([]);
    expect(inWords([])).toBe('neutral');
    expect(inWords(sharesAt({ activation: 17.3 / 2, evaluation: 42.2 / 2, power: 12.5 / 2 }))).toBe('50 % joy');
  });
});

describe('the text of the face', () => {
  it('names every control parameter that the player has, each once', () => {
    const rows = source('crate/tissue/src/muscles.tsv')
      .trimEnd()
      .split('\n')
      .slice(1)
      .map((line) => line.split('\t'));
    const muscles = rows.flatMap(([name = '', sides]) => (sides === 'pair' ? [`${name}Left`, `${name}Right`] : [name]));
    expect(muscles.length).toBeGreaterThan(30);
    expect(
      MUSCLES.flatMap((r) => r.dials)
        .flatMap(namesOf)
        .sort(),
    ).toEqual([...muscles].sort());
    const table = /DIRECT: \[[^=]*= \[([\s\S]*?)\n\];/.exec(source('crate/actor/src/parameters/control.rs'))?.[1] ?? '';
    for (const [, name, signed] of table.matchAll(/\("(\w+)", (true|false)\)/g)) {
      const dial = ALL.find((d) => namesOf(d).includes(name ?? ''));
      expect(dial?.signed, name).toBe(signed === 'true');
    }
    const visemes = /VISEMES: \[[^=]*= \[([\s\S]*?)\n\];/.exec(source('crate/actor/src/parameters/name.rs'))?.[1] ?? '';
    expect([...visemes.matchAll(/\("(\w+)",/g)].map(([, name]) => `Viseme${name}`)).toEqual(ALL.map((d) => d.name).filter((n) => n.startsWith('Viseme')));
  });

  it('has a slider for a muscle that a row is added for, in its region', () => {
    const longer = `${source('crate/tissue/src/muscles.tsv')}Wiggler\tpair\tWiggler\t0.2\t1.0\t-\t-\t-\t0\tTemples, ears and jaw\tWiggler\twiggles\n`;
    const regions = musclesOf(longer);
    const added = { name: 'Wiggler', label: 'Wiggler', note: 'wiggles', paired: true, signed: false };
    expect(regions.map((r) => r.title)).toEqual(MUSCLES.map((r) => r.title));
    expect(regions.flatMap((r) => r.dials).filter((d) => !ALL.some((known) => known.name === d.name))).toEqual([added]);
    expect(regions.find((r) => r.title === 'Temples, ears and jaw')?.dials.at(-1)).toEqual(added);
  });

  it('says nothing of what rests, and both sides in one where they are equal', () => {
    expect(write(beginning())).toBe('<eml name="face">\n  <body>\n    <null time="600"/>\n  </body>\n</eml>\n');
    const both = written((s) => (s.values = { ZygomaticusMajorLeft: 0.4, ZygomaticusMajorRight: 0.4 }));
    expect(both).toContain('<body-set-control-parameter time="0" parameterId="ZygomaticusMajor" value="0.4"/>');
    const left = written((s) => (s.values = { ZygomaticusMajorLeft: 0.4 }));
    expect(left).toContain('parameterId="ZygomaticusMajorLeft" value="0.4"');
    expect(left).not.toContain('Right');
  });

  it('comes back as it was written: every parameter, every word', () => {
    const values = Object.fromEntries(ALL.flatMap((d) => namesOf(d).map((name, i) => [name, d.signed ? -0.25 - i / 10 : 0.5 + i / 10])));
    expect(read(written((s) => (s.values = { ...values }))).values).toEqual(values);
    for (const { activation, evaluation, power, word, also } of WORDS) {
      const back = read(written((s) => (s.emotion = { activation, evaluation, power })));
      expect(back).toMatchObject({ emotion: { activation, evaluation, power }, word, values: {} });
      // Words at one position stay separate, because they may look different.
      for (const own of also) expect(read(written((s) => Object.assign(s, { emotion: { activation, evaluation, power }, word: own }))).word).toBe(own);
    }
    const between = { activation: 20, evaluation: 10, power: 5 };
    const back = read(written((s) => (s.emotion = { ...between }))).emotion;
    expect(Math.hypot(back.activation - 20, back.evaluation - 10)).toBeLessThan(1);
    expect(
      read('<eml><body><body-set-control-parameter time="0" parameterId="Jaw" value="7"/><body-set-control-parameter parameterId="Ear" value="x"/></body></eml>').values,
    ).toEqual({ Jaw: 1 });
  });

  it('declares the extensions where it uses them, and lets nobody write markup by a line', () => {
    const layers = written((s) => (s.layers = { skin: false, springs: true, muscles: true, skull: false }));
    expect(layers).toContain('xmlns:r="urn:raconteur:eml:1"');
    expect(layers).toContain('<body-configure-geometry time="0" r:isBodyVisible="false" r:areSpringsVisible="true" r:areMusclesVisible="true"/>');
    const text = written((s) => (s.speech = { kind: 'text', text: 'a < b & <null time="9"/> r:x' }));
    expect(text).toContain('a &lt; b &amp; &lt;null time="9"/> r:x');
    expect(text).not.toContain('xmlns');
    expect(text).toContain('<null time="said+1s"/>');
  });
});

describe('sentences of a story', () => {
  it('are all there, without the marks that the rest of the story hangs on', () => {
    const found = lines(source('assets/stories/white-rabbit/story.eml'));
    expect(found.length).toBe([...source('assets/stories/white-rabbit/story.eml').matchAll(/<voice-text/g)].length);
    expect(found[0]?.label).toMatch(/^Once upon a time, there was a little white rabbit, who lived/);
    for (const { markup } of found) expect(markup).not.toMatch(/<tm|time=|timeId/);
    const [first] = found;
    if (first === undefined) throw new Error('no sentence');
    const eml = written((s) => (s.speech = { kind: 'story', line: first }));
    expect(eml).toMatch(/<voice-text time="0.5">[\s\S]*<emph>little<\/emph>[\s\S]*<tm name="said"\/>\s*<\/voice-text>/);
  });

  it('keep the voice and the emotion that they are said in', () => {
    const found = lines(source('assets/stories/virtual-poets/zwei-parallelen/story.eml'));
    expect(found.length).toBeGreaterThan(3);
    for (const { before } of found) expect(before[0]).toMatch(/^<voice-change time=['"]0['"] voice='espeak-ng:de\+f2'\/>$/);
  });
});

/** Numbers of a sample. */
const WIDTH = MUSCLE_ORDER.flatMap(namesOf).length + DIRECT_CONTROLS.length;

describe('the course of a face', () => {
  const course = {
    names: ['p', 'aa'],
    segments: new Float32Array([0, 0.1, 0, 0.075, 2, 1, 1, 1, 20, 30, 0.1, 0.3, 0.2, 0.2, 1, 1, 1, 1, 10, 10]),
    curves: new Float32Array(3 * WIDTH),
  };

  it('has phones, whose dominance is full while they are held and falls to either side', () => {
    const [p, aa] = segmentsOf(course);
    if (p === undefined || aa === undefined) throw new Error('no segments');
    expect([p.name, p.held[1]]).toEqual(['p', expect.closeTo(0.075, 6)]);
    expect(dominance(p, 0.03)).toBe(2);
    expect(dominance(aa, 0.1)).toBeCloseTo(Math.exp(-1), 5);
    expect(dominance(aa, 0.4)).toBeCloseTo(Math.exp(-2), 5);
  });

  it('shows what moves most, two sides as one where they do the same', () => {
    const curves = new Float32Array(3 * WIDTH);
    const names = MUSCLE_ORDER.flatMap(namesOf);
    const place = (name: string): number => names.indexOf(name);
    // Both smile, the left brow frowns, and a jaw opens half.
    for (const [i, v] of [
      [place('ZygomaticusMajorLeft'), 0.8],
      [place('ZygomaticusMajorRight'), 0.8],
      [place('CorrugatorSuperciliiLeft'), 0.3],
      [names.length, 0.175],
    ] as const)
      curves[WIDTH + i] = v;
    expect(WIDTH).toBe(names.length + 16);
    expect(liveliest(curvesOf({ curves }, 3), 9).map((c) => [c.name, Number(c.values[1]?.toFixed(3))])).toEqual([
      ['Zygomaticus major', 0.8],
      ['Jaw', 0.5],
      ['Corrugator supercilii, left', 0.3],
    ]);
    expect(liveliest(curvesOf({ curves }, 3), 1).length).toBe(1);
  });
});
