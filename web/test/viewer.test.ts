import { describe, expect, it } from 'vitest';
import { addressOf } from '../element/engine/animations.js';
import { SHELVED } from '../pages/viewer/clips.js';
import { SpeedHistory } from '../pages/viewer/paces.js';
import { beginning, GROUPS, track, type State } from '../pages/viewer/state.js';
import { anglesOf, targetNow, toPlace, toWorld } from '../pages/viewer/turns.js';
import { write } from '../pages/viewer/write.js';
import type { PoseNow, Vector } from '../element/engine/pose.js';

const written = (edit: (state: State) => void): string => {
  const state = beginning();
  edit(state);
  return write(state);
};

/** Returns the weights that a player derives from the layer clauses (GEVH 3.2.1): the others share the remainder in their previous proportion. */
function weights(eml: string, layers: number): number[] {
  const now = Array.from({ length: layers }, () => 1 / layers);
  for (const [, value, index] of eml.matchAll(/property="weight" newValue="([\d.]+)">\s*<tracks><ly index="(\d+)"/g)) {
    const i = Number(index);
    const rest = now.reduce((sum, w, k) => sum + (k === i ? 0 : w), 0);
    const left = 1 - Number(value);
    for (let k = 0; k < layers; k++) if (k !== i) now[k] = rest > 1e-9 ? (left * (now[k] ?? 0)) / rest : left / (layers - 1);
    now[i] = Number(value);
  }
  return now;
}

describe('the text of the viewer', () => {
  it('weighs layers as their sliders say, whatever their sum', () => {
    for (const wanted of [
      [0.7, 0.3],
      [1, 1, 1],
      [0, 0.5, 0.25, 0.25],
      [0.2, 0, 0.6],
      [0, 0, 1],
    ]) {
      const eml = written((s) => (s.layers = wanted.map((weight) => track('nod', { weight }))));
      const sum = wanted.reduce((a, b) => a + b);
      weights(eml, wanted.length).forEach((weight, i) => expect(weight).toBeCloseTo((wanted[i] ?? 0) / sum, 3));
    }
  });

  it('says how an animation plays only where that is not usual', () => {
    const plain = written((s) => (s.layers = [track('nod')]));
    expect(plain).not.toMatch(/animation-style|speed|enable|weight|xmlns/);
    const all = written((s) => (s.layers = [track('nod', { style: 'iterations', times: 3, speed: 0.5, on: false })]));
    expect(all).toContain('<eml xmlns:r="urn:raconteur:eml:1" name="viewer">');
    expect(all).toContain('<animation-style playbackStyle="iterations" r:iterations="3"/>');
    expect(all).toContain('property="speed" newValue="0.5"');
    expect(all).toContain('property="enable" newValue="false"');
  });

  it('has a player for each mechanism, and none for none', () => {
    for (const [mechanism, type] of [
      ['layers', 'multiple'],
      ['groups', 'bodyGroup'],
      ['stances', 'pose'],
    ] as const) {
      expect(written((s) => (s.mechanism = mechanism))).toContain(`type="${type}"`);
    }
    expect(written((s) => (s.mechanism = 'none'))).not.toContain('player');
    const groups = written((s) => {
      s.mechanism = 'groups';
      for (const group of GROUPS) s.groups[group] = track('');
      s.groups.left_hand = track('wave');
    });
    expect(groups.match(/primitive="push"/g)).toHaveLength(1);
    expect(groups).toContain('<tracks><bg name="left_hand"/></tracks>');
  });

  it('leads limbs by targets or joints, and says nothing of free ones', () => {
    expect(written(() => undefined)).not.toContain('manipulator');
    const eml = written((s) => {
      Object.assign(s.limbs.leftArm, { lead: 'place', place: [10, 60.5, -8], angles: [0, 10, -90], way: 'line', lock: true });
      Object.assign(s.limbs.head, { lead: 'joints', joints: [0, 0, 30, 0, 0], limits: false });
    });
    expect(eml).toMatch(/frame-interpolation time="0" manipulator="leftArm" timePeriod="[\d.]+" posX="10" posY="60.5" posZ="-8" yaw="0" pitch="10" roll="-90"/);
    expect(eml).toMatch(/lock time="[\d.]+" manipulator="leftArm" isLock="true"/);
    expect(eml).toContain('<body-configure-manipulator time="0" manipulator="head" jointLimitsActive="false"/>');
    expect(eml).toContain('nJoints="5" j1="0" j2="0" j3="30" j4="0" j5="0"/>');
  });

  it('tells of the look what differs from the stage', () => {
    expect(written(() => undefined)).not.toContain('geometry');
    const eml = written((s) => Object.assign(s.look, { fill: 'wireframe', skin: false, bones: true, textures: false }));
    expect(eml).toContain('<body-configure-geometry time="0" fillMode="wireframe" visibleMeshes="bones" areTexturesActive="false"/>');
  });
});

describe('the speed of an animation', () => {
  /** Returns the phase of a layer's animation at a time, as given by the text. */
  function phase(eml: string, layer: number, secs: number): number {
    const set = [...eml.matchAll(/time="([\d.]+)" player="layers" property="speed" newValue="([-\d.]+)">\s*<tracks><ly index="(\d+)"/g)].filter(
      ([, , , index]) => Number(index) === layer,
    );
    const speeds = [{ at: 0, speed: 1 }, ...set.map(([, at, speed]) => ({ at: Number(at), speed: Number(speed) }))];
    return speeds.reduce((sum, { at, speed }, i) => sum + speed * Math.max(0, Math.min(secs, speeds[i + 1]?.at ?? secs) - at), 0);
  }

  it('changes without a jump, by sliders and by undo, for each layer by itself', () => {
    let state = beginning();
    const paces = new SpeedHistory(state);
    const text = () => write(state, (track) => paces.of(track));
    const follow = (secs: number, edit: () => void): void => {
      const before = [0, 1].map((layer) => phase(text(), layer, secs));
      edit();
      paces.follow(state, secs);
      [0, 1].forEach((layer) => expect(phase(text(), layer, secs)).toBeCloseTo(before[layer] ?? 0, 3));
    };
    const speed = (layer: number, value: number) => () => void (state.layers[layer]!.speed = value);
    follow(10, speed(0, 0.5));
    follow(10.02, speed(0, 0.55));
    follow(31.4, speed(1, -2));
    const settled = JSON.stringify(state);
    follow(250, speed(0, 3));
    follow(260, () => (state = JSON.parse(settled) as State));
    expect(phase(text(), 0, 261) - phase(text(), 0, 260)).toBeCloseTo(0.55, 6);
    expect(phase(text(), 1, 261) - phase(text(), 1, 260)).toBeCloseTo(-2, 6);
    // A layer that moves up keeps its speed.
    const moved = phase(text(), 1, 300);
    state.layers.splice(0, 1);
    paces.follow(state, 300);
    expect(phase(text(), 0, 300)).toBeCloseTo(moved, 3);
  });

  it('is that of the control all along from the start, and for another animation', () => {
    const state = beginning();
    const paces = new SpeedHistory(state);
    const text = () => write(state, (track) => paces.of(track));
    for (const layer of state.layers) layer.speed = 2;
    paces.follow(state, 5);
    expect(text()).toContain('time="5"');
    state.layers[0] = track('nod', { weight: 0.7, speed: 2 });
    paces.follow(state, 6);
    expect(text().match(/time="5"/g)).toHaveLength(1);
    expect(paces.restart(7)).toBe(false);
    expect(paces.restart(0)).toBe(true);
    expect(text()).toBe(write(state));
  });
});

describe('places and turns', () => {
  it('go to EML and back', () => {
    const pose = { metresPerUnit: 0.022 };
    expect(toPlace(pose, toWorld(pose, [3.2, 60, -12.5]))).toEqual([3.2, 60, -12.5]);
  });

  it('are read from the frames of the neutral pose', () => {
    const [left, up, front]: Vector[] = [
      [1, 0, 0],
      [0, 1, 0],
      [0, 0, 1],
    ];
    const down: Vector = [0, -1, 0];
    const back: Vector = [0, 0, -1];
    const right: Vector = [-1, 0, 0];
    if (left === undefined || up === undefined || front === undefined) throw new Error('axes');
    // A standing leg and a hanging arm: x down, y left, z front (GEVH table 3.1).
    expect(anglesOf([down, left, front])).toEqual([0, 0, -90]);
    expect(anglesOf([left, up, front])).toEqual([0, 0, 0]);
    // The face to the figure's left is a negative yaw in EML's left-handed axes.
    expect(anglesOf([back, up, left])).toEqual([-90, 0, 0]);
    const joint = (name: string, axes: readonly [Vector, Vector, Vector]) => ({ name, parent: 0, position: [0.5, 1, 0.1] as Vector, axes });
    const pose = { metresPerUnit: 0.02, joints: [joint('bone_l_wrist', [down, front, right]), joint('bone_skull', [up, front, left])] } as unknown as PoseNow;
    expect(targetNow(pose, 'leftArm')).toEqual({ place: [25, 50, -5], angles: [0, 0, -90] });
    expect(targetNow(pose, 'head')?.angles).toEqual([0, 0, 0]);
    expect(targetNow(pose, 'rightArm')).toBeUndefined();
  });
});

describe('animations', () => {
  it('stand on shelves, each once', () => {
    const names = SHELVED.flatMap(({ clips }) => clips.map(({ name }) => name));
    expect(new Set(names).size).toBe(names.length);
    expect(names).toContain('step-march');
    expect(SHELVED.every(({ clips }) => clips.length > 3)).toBe(true);
    for (const { clip } of [...beginning().layers, ...Object.values(beginning().groups)]) if (clip !== '') expect(names).toContain(clip);
  });

  it('are fetched from the library, or from within the folder of the story', () => {
    const [library, story] = [new URL('http://a/assets/'), new URL('http://a/stories/x/story.eml')];
    const address = (name: string) => addressOf(name, library, story)?.href;
    expect(address('nod')).toBe('http://a/assets/animations/nod.json');
    expect(address('own/bow.json')).toBe('http://a/stories/x/own/bow.json');
    for (const out of ['../y/bow.json', '/bow.json', 'http://b/bow.json', '//b/bow.json', 'own/../../y.json']) expect(address(out)).toBeUndefined();
  });
});
