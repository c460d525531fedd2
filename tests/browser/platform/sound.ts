/** Loudness, silence, and the device that plays. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const muted = 'user-interface/muted.html#';
const OLDER = 'Chromium 156 follows the attribute of elements of the parser alone';

/** Sets a volume; returns the exception, or the resulting value. */
const volume = ({ media, thrown }: Kit<Video>, text: string) => [thrown(() => (media.volume = Number(text))), media.volume];

const LOUDNESS: readonly (readonly [string, string, readonly unknown[]])[] = [
  ['audio_volume_check.html#in the range', '0.5', ['nothing', 0.5]],
  ['audio_volume_check.html#silent', '0', ['nothing', 0]],
  ['audio_volume_check.html#loudest', '1', ['nothing', 1]],
  ['audio_volume_check.html#less than 0', '-1.1', ['IndexSizeError', 1]],
  ['audio_volume_check.html#more than 1', '1.1', ['IndexSizeError', 1]],
  ['volume_nonfinite.html#NaN', 'NaN', ['TypeError', 1]],
  ['volume_nonfinite.html#Infinity', 'Infinity', ['TypeError', 1]],
  ['volume_nonfinite.html#-Infinity', '-Infinity', ['TypeError', 1]],
];

/** Switches the silence to and fro; the attribute stays. */
const toggle = ({ make }: Kit<Video>, hasAttribute: boolean) => {
  const media = make();
  if (hasAttribute) media.setAttribute('muted', '');
  const seen = [media.muted];
  for (let i = 0; i < 2; i++) {
    media.muted = !media.muted;
    seen.push(media.muted, media.hasAttribute('muted'));
  }
  return seen;
};

/** Returns the state after each of some steps: `muted`, or the value that the step reads. */
const steps = ({ make }: Kit<Video>, given: readonly string[]) => {
  const media = make();
  return given.map((step) => {
    const [name, value] = step.split(' = ');
    if (step === 'attribute') media.setAttribute('muted', '');
    else if (step === 'no attribute') media.removeAttribute('muted');
    else if (value !== undefined) media[name as 'muted' | 'defaultMuted'] = value === 'true';
    return step === 'defaultMuted' ? media.defaultMuted : media.muted;
  });
};

/** Returns an element created by the parser; the backend and similar attributes of a player are irrelevant here. */
const parsed = ({ tag }: Kit<Video>, attributes: string) => {
  const around = document.createElement('div');
  around.innerHTML = `<${tag} ${attributes}></${tag}>`;
  const media = around.firstElementChild as HTMLMediaElement;
  const seen = [media.muted, media.hasAttribute('muted')];
  media.muted = !media.muted;
  return [...seen, media.muted, media.hasAttribute('muted')];
};

const silence: readonly Row[] = [
  { test: `${muted}getting (script-created)`, ask: ({ make }) => make().muted, expected: false },
  { test: `${muted}setting (script-created)`, ask: toggle, given: false, expected: [false, true, false, false, false] },
  { test: `${muted}getting and setting with muted="" (script-created)`, ask: toggle, given: true, expected: [true, false, true, true, true], uncontrolled: OLDER },
  { test: `${muted}adding and removing the attribute dynamically`, ask: steps, given: ['attribute', 'no attribute'], expected: [true, false], uncontrolled: OLDER },
  { test: `${muted}adding the attribute has no effect after the setter`, ask: steps, given: ['muted = false', 'attribute'], expected: [false, false] },
  {
    test: `${muted}removing the attribute has no effect after the setter`,
    ask: steps,
    given: ['attribute', 'muted = true', 'no attribute'],
    expected: [true, true, true],
    uncontrolled: OLDER,
  },
  { test: `${muted}toggling defaultMuted affects muted`, ask: steps, given: ['defaultMuted = true', 'defaultMuted = false'], expected: [true, false], uncontrolled: OLDER },
  {
    test: `${muted}toggling muted does not change defaultMuted`,
    ask: steps,
    given: ['attribute', 'muted = false', 'defaultMuted', 'muted = true', 'defaultMuted'],
    expected: [true, false, true, true, true],
    uncontrolled: OLDER,
  },
  { test: `${muted}defaultMuted does not affect muted after the setter`, ask: steps, given: ['muted = true', 'defaultMuted = false'], expected: [true, true] },
  { test: `${muted}getting and setting (parser-created)`, ask: parsed, given: '', expected: [false, false, true, false] },
  { test: `${muted}getting and setting with muted="" (innerHTML-created)`, ask: parsed, given: 'muted', expected: [true, true, false, true] },
  {
    test: `${muted}cloning propagates muted (script-created)`,
    ask: ({ make }) => {
      const media = make();
      media.setAttribute('muted', '');
      const copy = media.cloneNode(true) as HTMLMediaElement;
      return [copy.hasAttribute('muted'), copy.muted];
    },
    expected: [true, true],
  },
  {
    test: `${muted}getting with muted="" after load`,
    ask: async ({ media, absent, event }) => {
      media.setAttribute('muted', '');
      media.muted = false;
      const failed = event('error');
      media.src = absent;
      await failed;
      return media.muted;
    },
    expected: false,
  },
  {
    test: 'audio_muted_check.html',
    ask: ({ media }) => {
      const seen = [media.muted];
      media.muted = true;
      seen.push(media.muted);
      media.muted = false;
      return [...seen, media.muted];
    },
    expected: [false, true, false],
  },
];

const events: readonly Row[] = [
  {
    test: 'event_volumechange.html#setting volume fires volumechange',
    ask: async ({ media, event }) => {
      const told = event('volumechange').then(() => media.volume);
      media.volume = 0.5;
      return await told;
    },
    expected: 0.5,
  },
  {
    test: 'event_volumechange.html#setting muted fires volumechange',
    ask: async ({ media, event }) => {
      const told = event('volumechange').then(() => media.muted);
      media.muted = true;
      return await told;
    },
    expected: true,
  },
  {
    test: 'event_volumechange.html#setting the same value tells nothing',
    ask: async ({ media, follow, wait }) => {
      const told = follow('volumechange');
      const { volume, muted } = media;
      media.volume = volume;
      media.muted = muted;
      await wait(50);
      return told;
    },
    expected: [],
  },
  {
    test: 'event_volumechange.html#each change is told once, after the script',
    ask: async ({ media, follow, wait }) => {
      const told = follow('volumechange');
      media.volume = 0.5;
      media.muted = true;
      const atOnce = told.length;
      await wait(50);
      return [atOnce, told.length];
    },
    expected: [0, 2],
  },
];

const devices: readonly Row[] = [
  { test: '/audio-output/HTMLMediaElement-sinkId-idl.html', ask: ({ media }) => [media.sinkId, typeof media.setSinkId], expected: ['', 'function'] },
  {
    test: '/audio-output/setSinkId.https.html#the default output always works',
    ask: async ({ media, settle }) => [await settle(media.setSinkId('')), media.sinkId],
    expected: ['kept', ''],
  },
  {
    test: '/audio-output/setSinkId.https.html#NotFoundError for a device that there is not',
    ask: async ({ media, settle }) => {
      const asked = settle(media.setSinkId('nonexistent_device_id'));
      const before = media.sinkId;
      return [before, await asked, media.sinkId];
    },
    expected: ['', 'NotFoundError', ''],
  },
];

const pitch: readonly Row[] = [
  {
    test: '/html/dom/idlharness.https.html#HTMLMediaElement interface: attribute preservesPitch',
    ask: ({ media }) =>
      [false, true, 0, 'yes'].map((value) => {
        media.preservesPitch = value as boolean;
        return media.preservesPitch;
      }),
    expected: [false, true, false, true],
  },
];

export const theme: Theme = {
  name: 'sound',
  control: 'audio',
  rows: [...LOUDNESS.map(([test, text, expected]) => ({ test, ask: volume, given: text, expected })), ...silence, ...events, ...devices, ...pitch],
};
