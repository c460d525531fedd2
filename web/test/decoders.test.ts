/** The numbers of a pose and of a course, decoded by name. */

import { expect, test } from 'vitest';
import { curvesOf, DIRECT_CONTROLS, segmentsOf } from '../element/face/course.js';
import { decodePose } from '../element/engine/pose.js';

test('a pose has its camera, units, joints and targets', () => {
  const camera = [0, 1, 4, 0, 1.2, 0, 0.5, 1.25, 0.1, 40];
  const axes = [1, 0, 0, 0, 0, 1, 0, -1, 0];
  const numbers = [...camera, 0.1, 0.9, 0.2, 0.0215, 2, -1, ...axes, 0, 1, 0, 0, ...axes, 0.2, 1.4, 0, 0.3, 1.5, 0.1, 0.004];
  const pose = decodePose({ names: ['root', 'wrist', 'rightArm'], numbers });
  expect(pose?.camera).toMatchObject({ eye: [0, 1, 4], target: [0, 1.2, 0], near: 0.1, far: 40 });
  expect([pose?.origin, pose?.metresPerUnit]).toEqual([[0.1, 0.9, 0.2], 0.0215]);
  expect(pose?.joints.map(({ name, parent, position }) => [name, parent, position])).toEqual([
    ['root', -1, [0, 1, 0]],
    ['wrist', 0, [0.2, 1.4, 0]],
  ]);
  expect(pose?.joints[1]?.axes).toEqual([
    [1, 0, 0],
    [0, 0, 1],
    [0, -1, 0],
  ]);
  expect(pose?.targets).toEqual([{ name: 'rightArm', position: [0.3, 1.5, 0.1], error: 0.004 }]);
  expect(decodePose({ names: [], numbers: [] })).toBeUndefined();
});

test('a course has its controls one by one, and its segments by field', () => {
  const width = 38 + DIRECT_CONTROLS.length;
  const { muscles, direct } = curvesOf({ curves: Float32Array.from({ length: 2 * width }, (_, i) => i) }, 2);
  expect(muscles).toHaveLength(38);
  expect(muscles[3]).toEqual([3, width + 3]);
  expect(direct.jawPitch).toEqual([38, width + 38]);
  expect(direct.blush).toEqual([width - 1, 2 * width - 1]);
  expect(curvesOf({ curves: new Float32Array() }, 3)).toMatchObject({ muscles: [], direct: { blush: [0, 0, 0] } });
  const segments = Float32Array.from({ length: 20 }, (_, i) => i);
  expect(segmentsOf({ curves: new Float32Array(), segments, names: ['p', 'aa'] })[1]).toEqual({ name: 'aa', start: 10, end: 11, held: [12, 13], alpha: 14, rates: [18, 19] });
});
