/** Joint angles read by the viewer from a pose, compared with those given to the engine. */

import { expect, test } from 'vitest';
import type { PoseNow, Vector } from '../element/engine/pose.js';
import { jointsNow } from '../pages/viewer/joints.js';
import { LIMBS, type LimbName } from '../pages/viewer/state.js';

/** The angles that `body-non-deterministic-fk` set on `sofia`, degrees. */
const TOLD: Readonly<Record<LimbName, readonly number[]>> = {
  leftArm: [35, 20, 60, 25, -12, 30],
  rightArm: [70, -15, 90, -30, 20, -25],
  leftLeg: [12, 40, 70, 10, 15, -5],
  rightLeg: [-8, -20, 30, -12, 25, 9],
  head: [10, 15, -30, 20, 12],
};

/** Result of `Player::pose` at 5 s: three axes and the position of each bone, ten thousandths. */
const BONES: Readonly<Record<string, readonly number[]>> = {
  sacroiliac: [-21, 10000, 0, 19, 0, 10000, 10000, 21, -19, 21, 9044, -183],
  thoracic: [-69, 10000, 19, 18, -19, 10000, 10000, 69, -18, 12, 11618, -305],
  cervical: [1616, 9519, 2603, -415, -2570, 9655, 9860, -1668, -21, -2, 13693, -348],
  skull: [1448, 7716, 6194, -5523, -4564, 6977, 8210, -4431, 3601, 215, 14966, 440],
  l_shoulder: [5537, -7602, 3398, -2147, 2639, 9403, -8046, -5936, -171, 1527, 13189, -93],
  l_elbow: [866, -1547, 9842, -5794, 7958, 1761, -8105, -5854, -207, 3047, 11051, 854],
  l_wrist: [-527, -6904, 7215, -8307, 4313, 3521, -5543, -5808, -5962, 3254, 10680, 3215],
  l_hip: [1582, -7284, 6666, 9785, 2061, -69, -1324, 6534, 7454, 894, 8664, 5],
  l_knee: [1646, -7862, -5957, 9777, 2100, -70, 1306, -5812, 8032, 1516, 5706, 2601],
  l_subtalar: [719, -9842, -1619, 9949, 592, 817, -708, -1670, 9834, 2158, 2520, 395],
  r_shoulder: [-9096, -3260, -2576, -2330, -1131, 9659, -3440, 9386, 269, -1526, 13167, -168],
  r_elbow: [-2330, -1131, 9659, 9059, 3360, 2578, -3537, 9350, 241, -4052, 12230, -887],
  r_wrist: [-2843, 3743, 8826, 6507, 7515, -1091, -7041, 5433, -4572, -4611, 11958, 1430],
  r_hip: [1334, -9406, -3121, -9900, -1410, 18, -457, 3087, -9500, -849, 8660, 9],
  r_knee: [746, -5461, -8344, -9902, -1397, 29, -1181, 8260, -5512, -303, 4940, -1311],
  r_subtalar: [-578, -7722, -6328, -9981, 580, 204, 209, 6328, -7741, 34, 2666, -4495],
};

const pose = {
  joints: Object.entries(BONES).map(([name, numbers]) => {
    const vector = (at: number): Vector => [(numbers[at] ?? 0) / 1e4, (numbers[at + 1] ?? 0) / 1e4, (numbers[at + 2] ?? 0) / 1e4];
    return { name: `bone_${name}`, parent: 0, axes: [vector(0), vector(3), vector(6)] as const, position: vector(9) };
  }),
} as unknown as PoseNow;

test.each(LIMBS)('the joints of %s are those that it was told', (name) => {
  const found = jointsNow(pose, name) ?? [];
  expect(found).toHaveLength(TOLD[name].length);
  // The upper arm at rest is rotated about its axis by 1.3 degrees, which none of the six joints
  // can express.
  found.forEach((angle, i) => expect(Math.abs(angle - (TOLD[name][i] ?? 0)), `joint ${i + 1}`).toBeLessThanOrEqual(2));
});

test('a figure without the bones tells no angles', () => {
  expect(jointsNow({ ...pose, joints: pose.joints.filter((joint) => joint.name !== 'bone_l_wrist') }, 'leftArm')).toBeUndefined();
});
