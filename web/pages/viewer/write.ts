/** The viewer's settings as EML. */

import { SETTLED_SECS } from '../page-state.js';
import { script, tag } from '../../speech/markup.js';
import type { SpeedChange } from './paces.js';
import { ends, GROUPS, LIMBS, LOOK, track as stand, type Limb, type LimbName, type Look, type State, type Track } from './state.js';

/** Duration of the script, seconds; then it restarts. */
export const LENGTH_SECS = 600;
/** Time for a limb to reach its target, seconds. */
const MOVE_SECS = 0.6;

/** Function that returns the speed of a track before it changed; undefined if it did not change. */
type SpeedOf = (track: Track) => SpeedChange | undefined;

/** Writes the clauses of one track of a player: animation, speed, and audibility. */
function onTrack(player: string, where: string, track: Track, paceOf: SpeedOf): string[] {
  const { clip, style, times, speed, on } = track;
  if (clip === '') return [];
  const pace = paceOf(track);
  const tracks = tag('tracks', {}, [where]);
  const plain = style === 'loop';
  return [
    tag('body-deterministic-primitive', { time: 0, primitive: 'push', player, animationSetName: clip }, [
      ...(plain ? [] : [tag('animation-style', { playbackStyle: style, 'r:iterations': ends(style) && times !== 1 ? times : undefined })]),
      tracks,
    ]),
    // Six digits, so that an animation is still in phase after minutes.
    ...(pace === undefined ? [] : [property(player, where, 'speed', String(Number(pace.speed.toFixed(6))))]),
    ...(pace === undefined && speed === 1 ? [] : [property(player, where, 'speed', speed, pace?.untilSecs)]),
    ...(on ? [] : [property(player, where, 'enable', false)]),
  ];
}

function property(player: string, where: string, name: string, value: number | boolean | string, time = 0): string {
  return tag('body-configure-deterministic-track-property', { time, player, property: name, newValue: value }, [tag('tracks', {}, [where])]);
}

/**
 * Writes the weights of layers. Each clause leaves the remainder to the other layers in their proportion (GEVH 3.2.1): so the first layer gets everything, and
 * each further one its share of the sum of itself and those before.
 */
function weigh(layers: readonly Track[]): string[] {
  let sum = 0;
  return layers.flatMap(({ weight }, i) => {
    sum += weight;
    const share = i === 0 ? 1 : sum > 0 ? weight / sum : 0;
    return layers.length === 1 ? [] : [property('layers', layer(i), 'weight', Number(share.toFixed(4)))];
  });
}

const layer = (index: number): string => tag('ly', { index });

function animations(state: State, paceOf: SpeedOf): string[] {
  const add = (name: string, type: string, numberOfLayers?: number): string => tag('body-player-add', { time: 0, name, type, numberOfLayers });
  const pass = tag('body-configure-deterministic-animation', { time: 0, smooth: state.swapSecs > 0, swapTime: state.swapSecs > 0 ? state.swapSecs : undefined });
  switch (state.mechanism) {
    case 'none':
      return [];
    case 'layers':
      return [pass, add('layers', 'multiple', state.layers.length), ...state.layers.flatMap((track, i) => onTrack('layers', layer(i), track, paceOf)), ...weigh(state.layers)];
    case 'groups':
      return [pass, add('groups', 'bodyGroup'), ...GROUPS.flatMap((name) => onTrack('groups', tag('bg', { name }), state.groups[name], paceOf))];
    case 'stances': {
      const { from, to, blend } = state.stances;
      const stance = (index: number, clip: string): string[] => onTrack('stances', layer(index), stand(clip), paceOf);
      return [pass, add('stances', 'pose'), ...stance(0, from), ...stance(1, to), property('stances', layer(1), 'weight', blend)];
    }
  }
}

function manipulator(name: LimbName, limb: Limb): string[] {
  if (limb.lead === 'free') return [];
  const limits = limb.limits ? [] : [tag('body-configure-manipulator', { time: 0, manipulator: name, jointLimitsActive: false })];
  if (limb.lead === 'joints') {
    const joints = Object.fromEntries(limb.joints.map((angle, i) => [`j${i + 1}`, angle]));
    return [...limits, tag('body-non-deterministic-fk', { time: 0, manipulator: name, nJoints: limb.joints.length, ...joints })];
  }
  const [posX, posY, posZ] = limb.place;
  const [yaw, pitch, roll] = limb.angles;
  const target = { posX, posY, posZ, yaw, pitch, roll };
  const start = { time: 0, manipulator: name };
  const ways = {
    joints: () => tag('body-non-deterministic-joint-interpolation', { ...start, staticTime: MOVE_SECS, ...target }),
    line: () => tag('body-non-deterministic-frame-interpolation', { ...start, timePeriod: MOVE_SECS, ...target }),
    velocity: () => tag('body-non-deterministic-jacobian', { ...start, isStaticTarget: true, ...target }),
  };
  const lock = limb.lock ? [tag('body-non-deterministic-lock', { time: SETTLED_SECS - 0.5, manipulator: name, isLock: true })] : [];
  return [...limits, ways[limb.way](), ...lock];
}

function geometry(look: Look): string[] {
  const changed = (key: keyof Look): boolean | undefined => (look[key] === LOOK[key] ? undefined : Boolean(look[key]));
  const attributes = {
    time: 0,
    fillMode: look.fill === LOOK.fill ? undefined : look.fill,
    visibleMeshes: look.bones ? (look.skin ? 'both' : 'bones') : undefined,
    areMaterialsActive: changed('materials'),
    areTexturesActive: changed('textures'),
    areFramesVisible: changed('frames'),
    areHierarchyCentersVisible: changed('centers'),
    areManipulatorsVisible: changed('manipulators'),
  };
  return Object.values(attributes).filter((value) => value !== undefined).length > 1 ? [tag('body-configure-geometry', attributes)] : [];
}

/** Writes a complete script that sets everything at its beginning, except for speeds that have changed since. */
export function write(state: State, paceOf: SpeedOf = () => undefined): string {
  const clauses = [...animations(state, paceOf), ...LIMBS.flatMap((name) => manipulator(name, state.limbs[name])), ...geometry(state.look), tag('null', { time: LENGTH_SECS })];
  const extended = clauses.some((clause) => clause.includes(' r:'));
  return script('viewer', extended, clauses);
}
