/** Palms, timing curves and camera of the pages, compared with the engine. */

import { expect, test } from 'vitest';
import type { PalmFunctions } from '../element/engine/backend.js';
import { cross, dot, Lens, type Vector } from '../element/engine/pose.js';
import type { Vector3 } from '../pages/gestures/gesture.js';
import { ORIENTATIONS, orientationName, orientationOf } from '../pages/gestures/orientations.js';
import { Palms } from '../pages/gestures/palm.js';
import { wayAt } from '../pages/gestures/profile.js';
import { roll, twist } from '../pages/gestures/roll.js';
import { COMPILE_MS, openBuild } from './build.js';

const openPalms = async (): Promise<Palms> => new Palms(await openBuild<PalmFunctions>());

/** Converts between EML's axes, with z to the back, and the engine's, with z to the front. */
const flipDepth = ([x, y, z]: Vector3): Vector3 => [x, y, -z];
const [LEFT, RIGHT, UP, DOWN, FRONT, BACK]: Vector3[] = [
  [1, 0, 0],
  [-1, 0, 0],
  [0, 1, 0],
  [0, -1, 0],
  [0, 0, 1],
  [0, 0, -1],
];
const near = (a: readonly number[], b: readonly number[], digits = 9) => a.forEach((x, i) => expect(x).toBeCloseTo(b[i] ?? NaN, digits));

test(
  'the fingers of a right hand point as the engine has them',
  async () => {
    const palms = await openPalms();
    // The table of `crate/actor/src/palm.rs`: at -90, 0, 90 and 180 degrees.
    const table: [Vector3, Vector3[]][] = [
      [LEFT!, [BACK!, DOWN!, FRONT!, UP!]],
      [RIGHT!, [FRONT!, DOWN!, BACK!, UP!]],
      [UP!, [BACK!, LEFT!, FRONT!, RIGHT!]],
      [DOWN!, [BACK!, RIGHT!, FRONT!, LEFT!]],
      [FRONT!, [LEFT!, DOWN!, RIGHT!, UP!]],
      [BACK!, [RIGHT!, DOWN!, LEFT!, UP!]],
    ];
    for (const [normal, fingers] of table) {
      fingers.forEach((expected, k) => {
        const directions = palms.directionsOf('right', flipDepth(normal), (k - 1) * 90);
        near(directions.fingers, expected);
        near(directions.normal, normal);
        // The left hand is its mirror image.
        const left = palms.directionsOf('left', flipDepth([-normal[0], normal[1], normal[2]]), -(k - 1) * 90);
        near(left.fingers, [-expected[0], expected[1], expected[2]]);
      });
    }
  },
  COMPILE_MS,
);

test(
  'directions become the normal and angle that mean them, whatever they are',
  async () => {
    const palms = await openPalms();
    // A vector without direction defaults to the front.
    expect(palms.directionsOf('left', [0, 0, 0], 10)).toEqual(palms.directionsOf('left', flipDepth(FRONT!), 10));
    for (let i = 0; i < 200; i += 1) {
      const [a, b, c, d] = [1, 2, 3, 4].map((k) => Math.sin(k * 12.9898 + i * 78.233) * 2) as [number, number, number, number];
      const hand = i % 2 === 0 ? 'right' : 'left';
      const directions = twist(roll(palms.directionsOf(hand, [a, b, c], d * 90), b, c), d);
      expect(dot(directions.normal, directions.fingers)).toBeCloseTo(0, 9);
      const { normal, angle } = palms.palmOf(hand, directions);
      const back = palms.directionsOf(hand, normal, angle);
      near(back.normal, directions.normal, 7);
      near(back.fingers, directions.fingers, 7);
      expect(Math.abs(angle)).toBeLessThanOrEqual(180);
    }
  },
  COMPILE_MS,
);

test('a ball rolls as a finger moves over it', () => {
  const front = { normal: FRONT!, fingers: UP! };
  // The right of the image is the speaker's left.
  near(roll(front, Math.PI / 2, 0).normal, LEFT!);
  near(roll(front, 0, Math.PI / 2).normal, UP!);
  near(twist(front, Math.PI / 2).fingers, RIGHT!);
  near(twist(front, Math.PI / 2).normal, FRONT!);
  near(cross(LEFT!, UP!), FRONT!);
});

test('courses go from 0 to 1 as the engine has them', () => {
  const all = [
    undefined,
    { kind: 'linear', controls: [] },
    { kind: 'cosine', controls: [] },
    { kind: 'bezier', controls: [0.2, 0, 0.4, 1.3] },
    { kind: 'hermite', controls: [0, 2] },
  ] as const;
  for (const course of all) {
    expect(wayAt(course, 0)).toBeCloseTo(0, 6);
    expect(wayAt(course, 1)).toBeCloseTo(1, 6);
  }
  expect(wayAt(undefined, 0.5)).toBe(0.5);
  expect(wayAt(undefined, 0.25)).toBeCloseTo(0.103515625, 12);
  expect(wayAt(all[2], 0.25)).toBeCloseTo(0.5 - Math.SQRT1_2 / 2, 12);
  // A Bézier with its points on the diagonal is a straight line.
  expect(wayAt({ kind: 'bezier', controls: [0.3, 0.3, 0.8, 0.8] }, 0.37)).toBeCloseTo(0.37, 6);
  // 3.9 u² - 2.9 u³ is greatest at u = 7.8 / 8.7.
  expect(Math.max(...Array.from({ length: 1000 }, (_, i) => wayAt(all[3], i / 1000)))).toBeCloseTo(1.0449, 4);
  // A Hermite curve has the given slopes.
  const steep = { kind: 'hermite', controls: [0.7, 2] } as const;
  expect(wayAt(steep, 1e-6) / 1e-6).toBeCloseTo(0.7, 3);
  expect((1 - wayAt(steep, 1 - 1e-6)) / 1e-6).toBeCloseTo(2, 3);
});

test('a point is projected to the canvas and back, and by the matrix, too', () => {
  const lens = new Lens([0.1, 1.4, 4], [0, 1.2, 0], 0.36, 1.25, 0.1, 40);
  const [width, height] = [500, 400];
  const points: Vector[] = [
    [0, 1.2, 0],
    [0.4, 1.6, 0.3],
    [-0.5, 0.9, 0.5],
  ];
  near(Object.values(lens.project(points[0]!, width, height) ?? {}), [250, 200]);
  for (const point of points) {
    const spot = lens.project(point, width, height);
    if (spot === undefined) throw new Error('behind');
    near(lens.unproject(spot, width, height, point, lens.forward) ?? [], point);
    const m = lens.clipFromWorld;
    const clip = [0, 1, 2, 3].map((row) => (m[row] ?? 0) * point[0] + (m[4 + row] ?? 0) * point[1] + (m[8 + row] ?? 0) * point[2] + (m[12 + row] ?? 0)) as [
      number,
      number,
      number,
      number,
    ];
    near([(0.5 + clip[0] / clip[3] / 2) * width, (0.5 - clip[1] / clip[3] / 2) * height], [spot.x, spot.y]);
    expect(clip[2] / clip[3]).toBeGreaterThan(0);
    expect(clip[2] / clip[3]).toBeLessThan(1);
  }
  expect(lens.project([0, 1, 9], width, height)).toBeUndefined();
  expect(lens.unproject({ x: 250, y: 200 }, width, height, [0, 0, 0], lens.right)).toBeUndefined();
});

test(
  'typical orientations of both hands point where their names say',
  async () => {
    const palms = await openPalms();
    // The pages' words for directions, in the engine's axes.
    const words: Readonly<Record<string, Vector3>> = { left: LEFT!, right: RIGHT!, up: UP!, down: DOWN!, front: FRONT!, listener: FRONT!, speaker: BACK! };
    for (const [name, known] of Object.entries(ORIENTATIONS)) {
      const said = /(?:^|[:\s])(?:to the )?(left|right|up|down|listener|speaker), fingers (\w+)$/i.exec(name);
      expect(said, name).not.toBeNull();
      const [palm, fingers] = [words[said![1]!.toLowerCase()]!, words[said![2]!]!];
      for (const hand of ['right', 'left'] as const) {
        const { normal, angle } = orientationOf(hand, known);
        const side = ([x, y, z]: Vector3): Vector3 => (hand === 'left' ? [-x, y, z] : [x, y, z]);
        const found = palms.directionsOf(hand, normal, angle);
        near(found.normal, side(palm));
        near(found.fingers, side(fingers));
        expect(orientationName(hand, { normal, angle: angle + 360 })).toBe(name);
      }
    }
    expect(orientationName('right', { normal: [0.6, 0.8, 0], angle: 90 })).toBeUndefined();
  },
  COMPILE_MS,
);
