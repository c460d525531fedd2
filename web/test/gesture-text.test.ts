/** Text of a gesture as seen by a form, and the form's changes to it. */

import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { expect, test } from 'vitest';
import { addKey, addPhase, removeKey, removePhase, setCourse, setDuration, setHands, setKeyTime, setPhase, setSpace, setStart, setValue } from '../pages/gestures/edit.js';
import { EXAMPLES } from '../pages/gestures/examples.js';
import { gestureOf, joined, mirror, toldApart, trackOf, type Gesture } from '../pages/gestures/gesture.js';
import { SHAPE_NAMES } from '../pages/gestures/shape-names.js';
import { apply, difference, read, within, type Change } from '../pages/source.js';
import { parseSecs, timesOf } from '../pages/gestures/time.js';

const gesture = (text: string): Gesture => gestureOf(read(text));
/** Returns EML with the extensions and the given body. */
const eml = (body: string): string => `<eml xmlns:r="urn:raconteur:eml:1">\n  <body>\n${body}\n  </body>\n</eml>\n`;
const TWO = eml(`    <gesture-key time="1" duration="2" handedness="right" r:phase="stroke">
      <hand-shapes><key time="0" id="4"/></hand-shapes>
      <!-- kept -->
      <motion r:interpolation='cosine'>
        <key time="50%" x="-7" y="45" z="3"/>
        <key x="-15" y="40" z="3"/>
      </motion>
    </gesture-key>`);

test('elements and attributes know where they stand', () => {
  const text = `<?xml version="1.0"?><!-- <a> --><a x='1' y="&lt;&quot;"><b/><c>t<d z="2"></d></c></a>`;
  const all = [...within(read(text))];
  expect(all.map((e) => e.name)).toEqual(['a', 'b', 'c', 'd']);
  const [a, , c] = all;
  expect(a?.attributes.map((at) => [at.name, at.value, text.slice(at.from, at.to)])).toEqual([
    ['x', '1', "x='1'"],
    ['y', '<"', 'y="&lt;&quot;"'],
  ]);
  expect(text.slice(a?.from, a?.to)).toBe(text.slice(text.indexOf('<a x')));
  expect(text.slice(c?.openTo, c?.closeFrom)).toBe('t<d z="2"></d>');
});

test('any text is read: broken tags, ends that nobody waits for, no end at all', () => {
  for (const text of ['', '<', '</', '<a', '<a b', '<a b=', '<a b="1', '<a><b></a>', '</x><a/>', '<a <b/>', '<!--', '<![CDATA[<a>', '<a b="1" b="2" / >', '<a>'.repeat(2000)]) {
    for (const element of within(read(text))) {
      expect(element.from).toBeLessThan(element.to);
      expect(element.to).toBeLessThanOrEqual(text.length);
      expect(element.openTo).toBeLessThanOrEqual(element.closeFrom);
    }
  }
  const closed = [...within(read('<a><b><c></a><d/>'))];
  expect(closed.map((e) => [e.name, e.parent?.name])).toEqual([
    ['a', undefined],
    ['b', 'a'],
    ['c', 'b'],
    ['d', undefined],
  ]);
});

test('a phase is read with its tracks, the times of its keys and their courses', () => {
  const [phase] = gesture(TWO).phases;
  expect(phase).toMatchObject({ name: 'stroke', startSecs: 1, durationSecs: 2, hands: 'right' });
  expect(phase?.tracks.map((t) => [t.feature, t.course?.kind, t.keys.map((k) => [k.secs, k.written])])).toEqual([
    ['shape', undefined, [[0, 'seconds']]],
    [
      'place',
      'cosine',
      [
        [1, 'percent'],
        [2, 'nothing'],
      ],
    ],
  ]);
  expect(phase?.tracks[1]?.keys[0]?.value).toEqual({ place: [-7, 45, 3] });
});

test('a lone key without a time lies at the start, and at the end of a phase that goes somewhere', () => {
  const secs = (name: string) =>
    gesture(eml(`<gesture-key duration="2" r:phase="${name}"><hand-shapes><key id="1"/></hand-shapes></gesture-key>`)).phases[0]?.tracks[0]?.keys[0]?.secs;
  expect(['stroke', 'prestroke', 'preparation', 'retraction', 'partial-retraction'].map(secs)).toEqual([0, 0, 2, 2, 2]);
});

test('times are those of the player: sequences, groups, names, repetitions; speech is not guessed', () => {
  const starts = (body: string) => {
    const element = read(eml(body))[0]?.children[0];
    if (element === undefined) throw new Error('no body');
    const times = timesOf(element);
    return [...within(element.children)].filter((e) => e.name === 'gesture-key').map((e) => times.get(e));
  };
  const key = (time: string, more = '') => `<gesture-key time="${time}" duration="0.5" ${more}/>`;
  expect(starts(`<seq time="1">${key('0')}${key('0.25s')}</seq>${key('2')}`)).toEqual([1, 1.75, 2]);
  expect(starts(`<par time="1">${key('0')}<seq time="1">${key('1')}</seq></par>`)).toEqual([1, 3]);
  expect(starts(`<seq time="0"><seq time="0" repetitionCount="3">${key('0')}</seq>${key('0')}</seq>`)).toEqual([0, 1.5]);
  expect(starts(`${key('later-0.5s')}<null time="3" timeId="later"/>${key('later + 1')}`)).toEqual([2.5, 4]);
  expect(starts(`<seq time="0"><voice-text time="0"/>${key('0')}</seq>${key('w')}`)).toEqual([undefined, undefined]);
  expect([parseSecs('2'), parseSecs('.5s'), parseSecs('1m'), parseSecs('a'), parseSecs('1 2')]).toEqual([2, 0.5, 60, undefined, undefined]);
});

/** Applies a change to a text; everything but the affected lines must stay. */
function changed(text: string, make: (g: Gesture) => readonly Change[]): string {
  return apply(text, make(gesture(text)));
}
const lines = (before: string, after: string) => after.split('\n').filter((line) => !before.split('\n').includes(line));
const phaseOf = (g: Gesture) => {
  const [phase] = g.phases;
  if (phase === undefined) throw new Error('no phase');
  return phase;
};
const keyOf = (g: Gesture, feature: 'shape' | 'palm' | 'place', index = 0) => {
  const key = trackOf(phaseOf(g), feature, 'right')?.keys[index];
  if (key === undefined) throw new Error('no key');
  return key;
};

test('a value changes in its place, and nothing else does', () => {
  expect(
    lines(
      TWO,
      changed(TWO, (g) => setValue(g, [keyOf(g, 'place')], { place: [-8.04, 45, 3] })),
    ),
  ).toEqual(['        <key time="50%" x="-8" y="45" z="3"/>']);
  expect(changed(TWO, (g) => setValue(g, [keyOf(g, 'place')], keyOf(g, 'place').value))).toBe(TWO);
  const mixed = changed(TWO, (g) => setValue(g, [keyOf(g, 'shape')], { shape: { id: 9, second: 3, weight: 0.25 } }));
  expect(mixed).toContain('<key time="0" id="9" r:id2="3" r:weight="0.25"/>');
  expect(gesture(mixed).phases[0]?.tracks[0]?.keys[0]?.value).toEqual({ shape: { id: 9, second: 3, weight: 0.25 } });
  expect(changed(mixed, (g) => setValue(g, [keyOf(g, 'shape')], { shape: { id: 4, weight: 0.5 } }))).toBe(TWO);
});

test('times stay as they are written: percent as percent, seconds as seconds', () => {
  expect(changed(TWO, (g) => setKeyTime(phaseOf(g), keyOf(g, 'place'), 0.5))).toContain('<key time="25%" x="-7"');
  expect(changed(TWO, (g) => setKeyTime(phaseOf(g), keyOf(g, 'place', 1), 9))).toContain('<key time="2" x="-15"');
  const half = changed(
    changed(TWO, (g) => setKeyTime(phaseOf(g), keyOf(g, 'shape'), 1)),
    (g) => setDuration(phaseOf(g), 1),
  );
  expect(gesture(half).phases[0]).toMatchObject({ durationSecs: 1 });
  expect(gesture(half).phases[0]?.tracks.map((t) => t.keys.map((k) => k.secs))).toEqual([[0.5], [0.5, 1]]);
  expect(changed(TWO, (g) => setStart(phaseOf(g), 1.25))).toContain('<gesture-key time="1.25"');
});

test('keys and tracks come and go, with the others where they were', () => {
  const added = changed(TWO, (g) => addKey(TWO, g, phaseOf(g), 'place', 'right', 1.5, { place: [1, 2, 3] }, false));
  expect(gesture(added).phases[0]?.tracks[1]?.keys.map((k) => [k.secs, k.value.place?.[0]])).toEqual([
    [1, -7],
    [1.5, 1],
    [2, -15],
  ]);
  const palm = changed(TWO, (g) => addKey(TWO, g, phaseOf(g), 'palm', 'right', 0.5, { palm: { normal: [0, 0, -1], angle: 90 } }, false));
  expect(palm).toContain('      <palms>\n        <key time="0.5" a="90" x="0" y="0" z="-1"/>\n      </palms>\n      <motion');
  expect(palm).toContain('<!-- kept -->');
  const gone = changed(palm, (g) => {
    const track = trackOf(phaseOf(g), 'palm', 'right');
    return track?.keys[0] === undefined ? [] : removeKey(palm, phaseOf(g), track, track.keys[0]);
  });
  expect(gone).toBe(TWO);
});

test('what is an extension binds its namespace, and only then', () => {
  const plain = '<eml><body><gesture-key time="1" duration="1"><motion><key x="1" y="2" z="3"/></motion></gesture-key></body></eml>';
  const course = changed(plain, (g) => setCourse(g, keyOf(g, 'place'), { kind: 'bezier', controls: [0.4, 0, 0.2, 1.1] }));
  expect(course).toBe(
    '<eml xmlns:r="urn:raconteur:eml:1"><body><gesture-key time="1" duration="1"><motion><key x="1" y="2" z="3" r:interpolation="bezier" r:controls="0.4 0 0.2 1.1"/></motion></gesture-key></body></eml>',
  );
  expect(keyOf(gesture(course), 'place').course).toEqual({ kind: 'bezier', controls: [0.4, 0, 0.2, 1.1] });
  expect(changed(plain, (g) => setCourse(g, keyOf(g, 'place'), undefined))).toBe(plain);
  // A document's own prefix is used.
  const other = plain.replace('<eml>', '<eml xmlns:ext="urn:raconteur:eml:1">');
  expect(changed(other, (g) => setPhase(g, phaseOf(g), 'stroke'))).toContain('duration="1" ext:phase="stroke"');
  expect(changed(TWO, (g) => [...setSpace(g, trackOf(phaseOf(g), 'place', 'right')!, 'joint')])).toContain(`<motion r:interpolation='cosine' r:space="joint">`);
});

test('the other hand does the mirror image, and back again is what it was', () => {
  const left = changed(TWO, (g) => setHands(TWO, g, phaseOf(g), 'left'));
  expect(left).toContain('handedness="left"');
  expect(left).toContain('x="7" y="45"');
  expect(changed(left, (g) => setHands(left, g, phaseOf(g), 'right'))).toBe(TWO);
  const both = changed(TWO, (g) => setHands(TWO, g, phaseOf(g), 'both'));
  expect(both).toBe(TWO.replace('"right"', '"both"'));
  const apart = changed(both, (g) => setHands(both, g, phaseOf(g), 'apart'));
  const phase = phaseOf(gesture(apart));
  expect(toldApart(phase)).toBe(true);
  expect(trackOf(phase, 'place', 'left')?.keys.map((k) => k.value.place?.[0])).toEqual([7, 15]);
  expect(trackOf(phase, 'place', 'left')?.course?.kind).toBe('cosine');
  expect(trackOf(phase, 'place', 'right')?.keys.map((k) => k.value.place?.[0])).toEqual([-7, -15]);
  expect(changed(apart, (g) => setHands(apart, g, phaseOf(g), 'both'))).toBe(both);
  expect(mirror({ palm: { normal: [0, 1, 0], angle: 90 } })).toEqual({ palm: { normal: [0, 1, 0], angle: -90 } });
});

test('where one phase ends and the next begins, one place is moved', () => {
  const text = EXAMPLES['Wave'] ?? '';
  const g = gesture(text);
  const [preparation, stroke] = g.phases;
  const first = preparation && trackOf(preparation, 'place', 'right')?.keys[0];
  const last = stroke && trackOf(stroke, 'place', 'right')?.keys.at(-1);
  if (first === undefined || last === undefined) throw new Error('no keys');
  expect(joined(g, preparation!, 'place', 'right', first).map((k) => k.secs)).toEqual([0.7, 0]);
  expect(joined(g, stroke!, 'place', 'right', last)).toEqual([last]);
});

test('phases come after each other and go', () => {
  const text = EXAMPLES['Wave'] ?? '';
  const more = changed(text, (g) => addPhase(text, g, 'prestroke', g.phases[0]));
  expect(gesture(more).phases.map((p) => p.name)).toEqual(['preparation', 'prestroke', 'stroke', 'poststroke', 'retraction']);
  expect(changed(more, (g) => (g.phases[1] === undefined ? [] : removePhase(more, g.phases[1])))).toBe(text);
  const empty = '<eml><body/></eml>';
  expect(gesture(changed(empty, (g) => addPhase(empty, g, 'stroke', undefined))).phases).toMatchObject([{ name: 'stroke', hands: 'right' }]);
});

test('every example is a gesture that the form understands whole', () => {
  for (const text of Object.values(EXAMPLES)) {
    const { phases } = gesture(text);
    expect(phases.length).toBeGreaterThan(1);
    expect(phases.every((p) => p.startSecs !== undefined && p.startSecs >= 0.9)).toBe(true);
    const keys = [...within(read(text))].filter((e) => e.name === 'key').length;
    expect(phases.flatMap((p) => p.tracks).flatMap((t) => t.keys)).toHaveLength(keys);
  }
});

test('the difference of two texts is small, and makes the one of the other', () => {
  expect(difference('abc', 'abc')).toBeUndefined();
  for (const [a, b] of [
    ['', 'x'],
    ['aaa', 'aa'],
    ['abcd', 'aXcd'],
    ['abab', 'ab'],
    ['x', ''],
  ] as const) {
    const change = difference(a, b);
    expect(change === undefined ? a : apply(a, [change])).toBe(b);
  }
});

test('the names of the hand shapes are those of the figures', () => {
  const rust = readFileSync(join(import.meta.dirname, '../../crate/body/src/hand_shape.rs'), 'utf8');
  const names = [...rust.matchAll(/\bshape\(\s*(\d+),\s*"([^"]+)"/g)].map(([, id, name]) => [Number(id), name]);
  expect(names).toEqual(SHAPE_NAMES.map((name, id) => [id, name]));
  expect(names).toHaveLength(61);
});
