/** Rows about constants, attributes and their initial values. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const idl = '/html/dom/idlharness.https.html#HTMLMediaElement interface: ';
const reflection = '/html/dom/reflection-embedded.html#audio.';
const cors = 'interfaces/HTMLElement/HTMLMediaElement/crossOrigin.html#';

/** Returns a constant of an instance and of its class. */
const constant = ({ media }: Kit<Video>, name: string) => [media, media.constructor].map((of) => (of as unknown as Record<string, unknown>)[name]);

/** Returns the initial value of a property of a newly created element. */
const first = ({ make }: Kit<Video>, name: string) => (make() as unknown as Record<string, unknown>)[name];

/** Returns the values of a property for texts of its attribute; null means no attribute. */
const told = ({ make }: Kit<Video>, { attribute, property, texts }: { attribute: string; property: string; texts: readonly (string | null)[] }) =>
  texts.map((text) => {
    const media = make();
    if (text === null) media.removeAttribute(attribute);
    else media.setAttribute(attribute, text);
    return (media as unknown as Record<string, unknown>)[property];
  });

/** Returns an attribute after its property was set. */
const written = ({ make }: Kit<Video>, { attribute, property, values }: { attribute: string; property: string; values: readonly unknown[] }) =>
  values.map((value) => {
    const media = make();
    (media as unknown as Record<string, unknown>)[property] = value;
    return media.getAttribute(attribute);
  });

const CONSTANTS: readonly (readonly [string, number])[] = [
  ['NETWORK_EMPTY', 0],
  ['NETWORK_IDLE', 1],
  ['NETWORK_LOADING', 2],
  ['NETWORK_NO_SOURCE', 3],
  ['HAVE_NOTHING', 0],
  ['HAVE_METADATA', 1],
  ['HAVE_CURRENT_DATA', 2],
  ['HAVE_FUTURE_DATA', 3],
  ['HAVE_ENOUGH_DATA', 4],
];

const FIRST: readonly (readonly [string, string, unknown])[] = [
  ['networkState_initial.html', 'networkState', 0],
  ['readyState_initial.html', 'readyState', 0],
  ['video_004.htm', 'currentTime', 0],
  ['offsets-into-the-media-resource/currentTime.html#initial value', 'currentTime', 0],
  ['location-of-the-media-resource/currentSrc.html#initial value', 'currentSrc', ''],
  ['error-codes/error.html#initial value', 'error', null],
  ['playing-the-media-resource/playbackRate.html#initial value', 'playbackRate', 1],
  ['src_reflects_attribute_not_source_elements.html#without the attribute', 'src', ''],
  [`${idl}attribute defaultPlaybackRate`, 'defaultPlaybackRate', 1],
  [`${idl}attribute paused`, 'paused', true],
  [`${idl}attribute ended`, 'ended', false],
  [`${idl}attribute seeking`, 'seeking', false],
  ['preserves-pitch.html#on at first', 'preservesPitch', true],
];

/** Attributes of the kind that is there or not. */
const FLAGS: readonly (readonly [string, string])[] = [
  ['autoplay', 'autoplay'],
  ['loop', 'loop'],
  ['controls', 'controls'],
  ['muted', 'defaultMuted'],
];

const METHODS = ['load', 'canPlayType', 'fastSeek', 'play', 'pause', 'addTextTrack'];

const reflected: readonly Row[] = [
  { test: `${cors}content attribute missing`, ask: told, given: { attribute: 'crossorigin', property: 'crossOrigin', texts: [null] }, expected: [null] },
  {
    test: `${cors}content attribute invalid or empty`,
    ask: told,
    given: { attribute: 'crossorigin', property: 'crossOrigin', texts: ['foobar', ''] },
    expected: ['anonymous', 'anonymous'],
  },
  {
    test: `${cors}content attribute in capitals`,
    ask: told,
    given: { attribute: 'crossorigin', property: 'crossOrigin', texts: ['ANONYMOUS', 'USE-CREDENTIALS', 'use-credentials'] },
    expected: ['anonymous', 'use-credentials', 'use-credentials'],
  },
  {
    test: `${cors}content attribute with letters beyond ASCII`,
    ask: told,
    given: { attribute: 'crossorigin', property: 'crossOrigin', texts: ['U\u017fe-credentials', 'USE-CREDENT\u0130ALS'] },
    expected: ['anonymous', 'anonymous'],
  },
  {
    test: `${cors}setting the property`,
    ask: written,
    given: { attribute: 'crossorigin', property: 'crossOrigin', values: ['', null, 'foobar', 'ANONYMOUS', 'use-credentials'] },
    expected: ['', null, 'foobar', 'ANONYMOUS', 'use-credentials'],
  },
  {
    test: `${reflection}preload: get`,
    ask: told,
    given: { attribute: 'preload', property: 'preload', texts: ['none', 'NONE', 'metadata', 'auto', '', 'bogus'] },
    expected: ['none', 'none', 'metadata', 'auto', 'auto', 'metadata'],
  },
  { test: `${reflection}preload: set`, ask: written, given: { attribute: 'preload', property: 'preload', values: ['none', 'bogus', 7] }, expected: ['none', 'bogus', '7'] },
  { test: `${reflection}src: set`, ask: written, given: { attribute: 'src', property: 'src', values: ['a b', '', 7, true] }, expected: ['a b', '', '7', 'true'] },
  {
    test: `${reflection}src: get`,
    ask: ({ make }) =>
      ['', 'x.wav', ' x.wav ', '/y', 'https://#bad'].map((address) => {
        const media = make();
        media.setAttribute('src', address);
        return media.src.replace(document.baseURI, '~/').replace(location.origin, '~');
      }),
    expected: ['~/', '~/x.wav', '~/x.wav', '~/y', 'https://#bad'],
  },
  {
    test: 'src_reflects_attribute_not_source_elements.html',
    ask: ({ make }) => {
      const media = make();
      media.append(Object.assign(document.createElement('source'), { src: 'x.wav' }));
      return [media.src, media.hasAttribute('src')];
    },
    expected: ['', false],
  },
  {
    test: 'preload_reflects_none_autoplay.html',
    ask: ({ make }) => {
      const media = make();
      media.autoplay = true;
      media.preload = 'none';
      return media.preload;
    },
    expected: 'none',
  },
];

const types: readonly Row[] = [
  {
    test: 'mime-types/canPlayType.html#application/octet-stream',
    ask: ({ media }) => ['', '; codecs="vorbis"', '; codecs="vp8, vorbis"'].map((codecs) => media.canPlayType(`application/octet-stream${codecs}`)),
    expected: ['', '', ''],
  },
  {
    test: 'mime-types/canPlayType.html#video/x-new-fictional-format',
    ask: ({ media }) => ['', ';codecs="kittens,bunnies"'].map((codecs) => media.canPlayType(`video/x-new-fictional-format${codecs}`)),
    expected: ['', ''],
  },
  { test: 'canPlayType_bogus_type.html', ask: ({ media }) => media.canPlayType('bogus/bogus'), expected: '' },
  { test: 'canPlayType_application_octet_stream.html', ask: ({ media }) => media.canPlayType('application/octet-stream'), expected: '' },
  {
    test: 'canPlayType_supported_but_no_codecs_parameter_1.html',
    ask: ({ media, type }) => ['maybe', 'probably'].includes(media.canPlayType(type)),
    expected: true,
  },
  {
    test: `${idl}calling canPlayType with too few arguments must throw TypeError`,
    ask: ({ media, thrown }) => thrown(() => (media.canPlayType as unknown as () => string)()),
    expected: 'TypeError',
  },
];

const historical: readonly Row[] = ['controller', 'mediaGroup', 'initialTime', 'startTime', 'startOffsetTime', 'removeTextTrack'].map((name) => ({
  test: name === 'removeTextTrack' ? 'interfaces/HTMLElement/HTMLMediaElement/removeTextTrack.html' : `historical.html#${name}`,
  ask: ({ media }: Kit<Video>, given: string) => given in media,
  given: name,
  expected: false,
}));

export const theme: Theme = {
  name: 'constants and attributes',
  control: 'audio',
  rows: [
    ...CONSTANTS.map(([name, value]) => ({ test: `${idl}constant ${name}`, ask: constant, given: name, expected: [value, value] })),
    ...FIRST.map(([test, name, value]) => ({ test, ask: first, given: name, expected: value })),
    { test: 'offsets-into-the-media-resource/duration.html', ask: ({ make }) => Number.isNaN(make().duration), expected: true },
    ...METHODS.map((name) => ({
      test: `${idl}operation ${name}`,
      ask: (kit: Kit<Video>, given: string) => given in kit.media,
      given: name,
      expected: true,
      ...(name === 'fastSeek' ? { uncontrolled: 'Chromium has no fastSeek' } : {}),
    })),
    ...FLAGS.map(([attribute, property]) => ({
      test: `${reflection}${property}`,
      ask: ({ make }: Kit<Video>, [attribute, property]: [string, string]) => {
        const media = make() as unknown as Record<string, unknown> & HTMLElement;
        const seen = [media[property]];
        media.setAttribute(attribute, 'false');
        seen.push(media[property]);
        media[property] = '';
        seen.push(media.hasAttribute(attribute));
        media[property] = 7;
        seen.push(media.getAttribute(attribute));
        return seen;
      },
      given: [attribute, property],
      expected: [false, true, false, ''],
    })),
    ...reflected,
    ...types,
    ...historical,
  ],
};
