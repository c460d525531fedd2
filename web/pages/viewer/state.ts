/** State of the viewer's controls: everything expressed in its EML. */

/** Combination of animations in a player (GEVH 3.2). */
export type Mechanism = 'none' | 'layers' | 'groups' | 'stances';

/** Playback style of an animation; the words of EML's `animation-style`. */
export type Style = 'loop' | 'loopReverse' | 'pingPong' | 'iterations' | 'iterationsReverse' | 'temporaryIterations' | 'temporaryIterationsReverse';

/** State of one track of a player. */
export interface Track {
  /** Name of the animation; empty for none. */
  clip: string;
  style: Style;
  /** Number of iterations, for finite styles. */
  times: number;
  speed: number;
  weight: number;
  on: boolean;
}

/** The body groups of GEVH fig. 3.3, as EML names them. */
export const GROUPS = ['head', 'torso', 'left_arm', 'right_arm', 'left_hand', 'right_hand', 'left_leg', 'right_leg'] as const;
export type Group = (typeof GROUPS)[number];

export const LIMBS = ['leftArm', 'rightArm', 'leftLeg', 'rightLeg', 'head'] as const;
export type LimbName = (typeof LIMBS)[number];

export type Vector3 = [number, number, number];

/** Control of a limb: none, a target in space, or its joints. */
export type DriveMode = 'free' | 'place' | 'joints';

/** Path of a limb's end to its target (GEVH D.3.21, D.3.22, D.3.24). */
export type MotionMode = 'joints' | 'line' | 'velocity';

/** State of one manipulator. */
export interface Limb {
  lead: DriveMode;
  /** Target in EML's world coordinates: units, x left, y up, z back. */
  place: Vector3;
  /** Yaw, pitch and roll, degrees. */
  angles: Vector3;
  /** Degrees. */
  joints: number[];
  way: MotionMode;
  limits: boolean;
  /** True if it stays in place while the body moves. */
  lock: boolean;
}

export type Fill = 'solid' | 'wireframe' | 'point';

/** Rendered parts of the figure. */
export interface Look {
  fill: Fill;
  skin: boolean;
  bones: boolean;
  frames: boolean;
  centers: boolean;
  materials: boolean;
  textures: boolean;
  manipulators: boolean;
}

export interface State {
  mechanism: Mechanism;
  layers: Track[];
  groups: Record<Group, Track>;
  /** Two stances, and the blend between them. */
  stances: { from: string; to: string; blend: number };
  /** Duration of transitions between animations, seconds; 0 for none. */
  swapSecs: number;
  limbs: Record<LimbName, Limb>;
  look: Look;
}

/** Maximum number of layers that the page offers; EML allows 64. */
export const MAX_LAYERS = 6;

export const track = (clip: string, rest: Partial<Track> = {}): Track => ({ clip, style: 'loop', times: 1, speed: 1, weight: 1, on: true, ...rest });

export const LOOK: Look = { fill: 'solid', skin: true, bones: false, frames: false, centers: false, materials: true, textures: true, manipulators: false };

function limb(place: Vector3, angles: Vector3, joints: number): Limb {
  return { lead: 'free', place, angles, joints: Array.from({ length: joints }, () => 0), way: 'joints', limits: true, lock: false };
}

/** Returns the initial state of the page. */
export function beginning(): State {
  const none = (): Track => track('');
  return {
    mechanism: 'layers',
    layers: [track('step-march', { weight: 0.7 }), track('arms-roll', { weight: 0.3 })],
    groups: {
      head: track('nod'),
      torso: track('shift-weight'),
      left_arm: track('hands-on-hips'),
      right_arm: track('wave'),
      left_hand: none(),
      right_hand: none(),
      left_leg: track('shift-weight'),
      right_leg: track('shift-weight'),
    },
    stances: { from: 'stand', to: 'hands-on-hips', blend: 0.5 },
    swapSecs: 0.4,
    limbs: {
      // Hanging arms, standing legs and an upright head, on the example skeleton (GEVH table A.1).
      leftArm: limb([11, 42, 0], [0, 0, -90], 6),
      rightArm: limb([-11, 42, 0], [0, 0, -90], 6),
      leftLeg: limb([4, 5, 1], [0, 0, -90], 6),
      rightLeg: limb([-4, 5, 1], [0, 0, -90], 6),
      head: limb([0, 69, 0], [0, 0, 0], 5),
    },
    look: { ...LOOK },
  };
}

/** Label of a joint, and its range, degrees: the 95th percentile of men, GEVH table B.1. */
export interface JointRange {
  readonly name: string;
  readonly least: number;
  readonly most: number;
}

const range = (name: string, least: number, most: number): JointRange => ({ name, least, most });

// The forearm's range is divided between the two ways as in
// `crate/actor/src/manipulator/limits.rs`.
const ARM = [
  range('Shoulder, to the side', -63, 188.7),
  range('Shoulder, forwards', -83.3, 210.9),
  range('Elbow', 0, 159),
  range('Forearm, turned in', -80.4, 71.5),
  range('Wrist, to the thumb', -47.9, 36.7),
  range('Wrist, bent', -78, 94.8),
];
const LEG = [
  range('Hip, to the side', -53.5, 53.5),
  range('Hip, forwards', -148, 148),
  range('Knee', 0, 145.6),
  range('Foot, turned in', -55, 63),
  range('Foot, toes down', -19.9, 79.6),
  range('Foot, sole out', -39, 35),
];
const HEAD = [
  range('Neck, tilted', -45, 45),
  range('Neck, forwards', -25, 40),
  range('Head, turned', -99.1, 99.6),
  range('Head, nodding', -71, 70),
  range('Head, tilted', -63.5, 63.5),
];

export const RANGES: Readonly<Record<LimbName, readonly JointRange[]>> = { leftArm: ARM, rightArm: ARM, leftLeg: LEG, rightLeg: LEG, head: HEAD };

export const LIMB_NAMES: Readonly<Record<LimbName, string>> = { leftArm: 'Left arm', rightArm: 'Right arm', leftLeg: 'Left leg', rightLeg: 'Right leg', head: 'Head' };

export const GROUP_NAMES: Readonly<Record<Group, string>> = {
  head: 'Head',
  torso: 'Torso',
  left_arm: 'Left arm',
  right_arm: 'Right arm',
  left_hand: 'Left hand',
  right_hand: 'Right hand',
  left_leg: 'Left leg',
  right_leg: 'Right leg',
};

/** Returns true if a style is finite. */
export const ends = (style: Style): boolean => /terations/.test(style);
