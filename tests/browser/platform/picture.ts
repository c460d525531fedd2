/** Rows about the image and its other outputs: frame callbacks, streams, picture-in-picture, quality. */

import type { Kit } from '../media-kit.js';
import type { Row, Theme, Video } from './rows.js';

const frames = '/video-rvfc/request-video-frame-callback.html#';
const pip = '/picture-in-picture/';
const sizes = '/html/semantics/embedded-content/the-video-element/';

const callbacks: readonly Row[] = [
  {
    test: `${frames}a callback is called once with its metadata`,
    ask: async ({ media, loaded, settle, wait }) => {
      await loaded();
      let calls = 0;
      const frame = new Promise<[number, VideoFrameCallbackMetadata]>((done) =>
        media.requestVideoFrameCallback((now, about) => {
          calls += 1;
          done([now, about]);
        }),
      );
      void settle(media.play());
      const [now, about] = await frame;
      await wait(300);
      const numbers = ['presentationTime', 'expectedDisplayTime', 'width', 'height', 'mediaTime', 'presentedFrames'] as const;
      return [calls, now > 0, numbers.map((name) => typeof about[name]), about.width === media.videoWidth, about.height === media.videoHeight, about.mediaTime >= 0];
    },
    expected: [1, true, Array.from({ length: 6 }, () => 'number'), true, true, true],
  },
  {
    test: `${frames}no metadata of streams`,
    ask: async ({ media, loaded, settle }) => {
      await loaded();
      const frame = new Promise<VideoFrameCallbackMetadata>((done) => media.requestVideoFrameCallback((_, about) => done(about)));
      void settle(media.play());
      const about = await frame;
      return ['captureTime', 'receiveTime', 'rtpTimestamp'].filter((name) => name in about);
    },
    expected: [],
  },
  {
    test: `${frames}handles differ`,
    ask: ({ media }) => {
      const handles = [0, 1, 2].map(() => media.requestVideoFrameCallback(() => undefined));
      return [new Set(handles).size, handles.every((handle) => handle > 0)];
    },
    expected: [3, true],
  },
  {
    test: `${frames}a cancelled callback is not called`,
    ask: async ({ media, loaded, settle, wait }) => {
      await loaded();
      const seen: string[] = [];
      const handle = media.requestVideoFrameCallback(() => seen.push('cancelled'));
      media.requestVideoFrameCallback(() => seen.push('kept'));
      media.cancelVideoFrameCallback(handle);
      void settle(media.play());
      await wait(500);
      return seen;
    },
    expected: ['kept'],
  },
  {
    test: `${frames}cancelling what there is not`,
    ask: ({ media, thrown }) => [thrown(() => media.cancelVideoFrameCallback(999)), thrown(() => media.cancelVideoFrameCallback(-1))],
    expected: ['nothing', 'nothing'],
  },
  {
    test: `${frames}callbacks come in the order of their requests`,
    ask: async ({ media, loaded, settle, until }) => {
      await loaded();
      const seen: number[] = [];
      for (const i of [0, 1, 2]) media.requestVideoFrameCallback(() => seen.push(i));
      void settle(media.play());
      await until(() => seen.length === 3);
      return seen;
    },
    expected: [0, 1, 2],
  },
  {
    test: `${frames}cancelled by another callback of the same frame`,
    ask: async ({ media, loaded, settle, until, wait }) => {
      await loaded();
      const seen: string[] = [];
      let second = 0;
      media.requestVideoFrameCallback(() => {
        seen.push('first');
        media.cancelVideoFrameCallback(second);
      });
      second = media.requestVideoFrameCallback(() => seen.push('second'));
      void settle(media.play());
      await until(() => seen.length > 0);
      await wait(200);
      return seen;
    },
    expected: ['first'],
  },
  {
    test: '/video-rvfc/request-video-frame-callback-repeating.html',
    ask: async ({ media, loaded, settle }) => {
      await loaded();
      void settle(media.play());
      const found: VideoFrameCallbackMetadata[] = [];
      for (let i = 0; i < 3; i++) found.push(await new Promise((done) => media.requestVideoFrameCallback((_, about) => done(about))));
      const grow = (name: 'mediaTime' | 'presentationTime') => found.every((about, i) => i === 0 || about[name] >= (found[i - 1]?.[name] ?? 0));
      return [grow('mediaTime'), grow('presentationTime'), new Set(found.map(({ presentedFrames }) => presentedFrames)).size];
    },
    expected: [true, true, 3],
  },
  {
    test: `${frames}a callback that is asked for in a callback waits for the next frame`,
    ask: async ({ media, loaded, settle, until }) => {
      await loaded();
      const seen: number[] = [];
      media.requestVideoFrameCallback((_, first) => {
        media.requestVideoFrameCallback((_, second) => seen.push(second.presentedFrames - first.presentedFrames));
      });
      void settle(media.play());
      await until(() => seen.length > 0);
      return (seen[0] ?? 0) > 0;
    },
    expected: true,
  },
  {
    test: `${frames}seeking while paused brings a frame`,
    ask: async ({ media, loaded }) => {
      await loaded();
      const frame = new Promise<number>((done) => media.requestVideoFrameCallback((_, { mediaTime }) => done(mediaTime)));
      media.currentTime = 0.5;
      return (await frame) >= 0;
    },
    expected: true,
  },
];

/** Rows about the displayed size in pixels, and its events. */
const pictures: readonly Row[] = [
  { test: `${sizes}intrinsic_sizes.htm#before there is a picture`, ask: ({ make }) => [make().videoWidth, make().videoHeight], expected: [0, 0] },
  {
    test: `${sizes}event_resize.html`,
    ask: async ({ media, good, event }) => {
      const told = event('resize').then(() => [media.videoWidth > 0, media.videoHeight > 0]);
      media.src = good;
      return await told;
    },
    expected: [true, true],
  },
  {
    test: 'event_order_durationchange_resize_loadedmetadata.html#with a picture',
    ask: async ({ media, good, event, follow }) => {
      const told = follow('durationchange', 'resize', 'loadedmetadata');
      const there = event('loadedmetadata');
      media.src = good;
      await there;
      return told;
    },
    expected: ['durationchange', 'resize', 'loadedmetadata'],
  },
  {
    test: '/media-playback-quality/idlharness.window.js',
    ask: async ({ media, loaded, until }) => {
      await loaded();
      await media.play();
      await until(() => media.currentTime > 0.3);
      const { creationTime, totalVideoFrames, droppedVideoFrames } = media.getVideoPlaybackQuality();
      return [creationTime > 0, totalVideoFrames > 0, droppedVideoFrames <= totalVideoFrames];
    },
    expected: [true, true, true],
  },
];

const streams: readonly Row[] = [
  {
    test: '/mediacapture-fromelement/creation.html#video and audio',
    ask: async ({ media, good, settle, until }) => {
      media.src = good;
      void settle(media.play());
      const stream = media.captureStream();
      await until(() => stream.getTracks().length === 2);
      return [stream.active, stream.getVideoTracks().length, stream.getAudioTracks().length];
    },
    expected: [true, 1, 1],
  },
  {
    test: '/mediacapture-fromelement/capture.html#data flows',
    ask: async ({ media, loaded }) => {
      await loaded();
      const stream = media.captureStream();
      await media.play();
      const recorder = new MediaRecorder(stream);
      const data = new Promise<number>((done) => (recorder.ondataavailable = ({ data }) => data.size > 0 && done(data.size)));
      recorder.start(100);
      const size = await data;
      recorder.stop();
      return size > 0;
    },
    expected: true,
  },
  {
    test: '/mediacapture-fromelement/ended.html',
    ask: async ({ media, loaded, event, until }) => {
      await loaded();
      const stream = media.captureStream();
      const over = event('ended');
      await media.play();
      await over;
      await until(() => stream.getTracks().length === 0);
      return [stream.getTracks().length, stream.active];
    },
    expected: [0, false],
  },
];

/** Returns the outcome of a picture-in-picture request. */
const asked = async ({ media, loaded, settle, make }: Kit<Video>, given: 'nothing loaded' | 'disabled') => {
  if (given === 'nothing loaded') return await settle(make().requestPictureInPicture());
  await loaded();
  media.disablePictureInPicture = true;
  return await settle(media.requestPictureInPicture());
};

const windows: readonly Row[] = [
  {
    test: `${pip}disable-picture-in-picture.html#the attribute`,
    ask: ({ make }) => {
      const media = make();
      const seen: unknown[] = [media.disablePictureInPicture];
      media.setAttribute('disablepictureinpicture', 'foo');
      seen.push(media.disablePictureInPicture);
      media.removeAttribute('disablepictureinpicture');
      seen.push(media.disablePictureInPicture);
      media.disablePictureInPicture = true;
      seen.push(media.getAttribute('disablepictureinpicture'));
      media.disablePictureInPicture = false;
      return [...seen, media.getAttribute('disablepictureinpicture')];
    },
    expected: [false, true, false, '', null],
  },
  { test: `${pip}disable-picture-in-picture.html#a request is rejected`, ask: asked, given: 'disabled', expected: 'InvalidStateError' },
  { test: `${pip}request-picture-in-picture.html#metadata must be there`, ask: asked, given: 'nothing loaded', expected: 'InvalidStateError' },
];

/** Returns the events of the picture-in-picture window, and the document's property. */
const told = async ({ media, loaded, event, follow }: Kit<Video>, type: 'enter' | 'leave') => {
  await loaded();
  const events = follow('enterpictureinpicture', 'leavepictureinpicture');
  const there = (event(`${type}pictureinpicture`) as Promise<Event>).then(({ target, bubbles, cancelable, composed }) => [target === media, bubbles, cancelable, composed]);
  const before = document.pictureInPictureElement;
  await media.requestPictureInPicture();
  const during = document.pictureInPictureElement === media;
  await document.exitPictureInPicture();
  return [await there, before, during, document.pictureInPictureElement, events.length > 0];
};

const shown: readonly Row[] = [
  { test: `${pip}enter-picture-in-picture.html`, ask: told, given: 'enter', expected: [[true, true, false, false], null, true, null, true] },
  { test: `${pip}leave-picture-in-picture.html`, ask: told, given: 'leave', expected: [[true, true, false, false], null, true, null, true] },
  {
    test: `${pip}picture-in-picture-window.html#dimensions`,
    ask: async ({ media, loaded }) => {
      await loaded();
      const { width, height } = await media.requestPictureInPicture();
      return [width > 0, height > 0, Math.abs(width / height - media.videoWidth / media.videoHeight) < 0.05];
    },
    expected: [true, true, true],
  },
  {
    test: `${pip}picture-in-picture-window.html#dimensions after exiting`,
    ask: async ({ media, loaded }) => {
      await loaded();
      const opened = await media.requestPictureInPicture();
      await document.exitPictureInPicture();
      return [opened.width, opened.height];
    },
    expected: [0, 0],
  },
  {
    test: `${pip}picture-in-picture-window.html#unchanged when it is asked for again`,
    ask: async ({ media, loaded, follow, wait }) => {
      await loaded();
      const events = follow('enterpictureinpicture');
      const first = await media.requestPictureInPicture();
      const second = await media.requestPictureInPicture();
      await wait(50);
      return [first === second, events];
    },
    expected: [true, ['enterpictureinpicture']],
  },
  {
    test: `${pip}picture-in-picture-element.html`,
    ask: async ({ media, loaded }) => {
      const before = document.pictureInPictureElement;
      await loaded();
      await media.requestPictureInPicture();
      const during = document.pictureInPictureElement === media;
      await document.exitPictureInPicture();
      return [before, during, document.pictureInPictureElement];
    },
    expected: [null, true, null],
  },
  {
    test: `${pip}disable-picture-in-picture.html#the window closes when it becomes true`,
    ask: async ({ media, loaded, until }) => {
      await loaded();
      await media.requestPictureInPicture();
      media.disablePictureInPicture = true;
      return await until(() => document.pictureInPictureElement === null);
    },
    expected: true,
  },
  {
    test: `${pip}disable-picture-in-picture.html#unchanged when it becomes false, or true for another`,
    ask: async ({ media, loaded, make }) => {
      await loaded();
      await media.requestPictureInPicture();
      media.disablePictureInPicture = false;
      make().disablePictureInPicture = true;
      const is = document.pictureInPictureElement === media;
      await document.exitPictureInPicture();
      return is;
    },
    expected: true,
  },
  {
    test: `${pip}exit-picture-in-picture.html#without a window`,
    ask: async ({ settle }) => await settle(document.exitPictureInPicture()),
    expected: 'InvalidStateError',
  },
  {
    test: `${pip}request-picture-in-picture.html#removed from the document`,
    ask: async ({ media, loaded, event }) => {
      await loaded();
      await media.play();
      await media.requestPictureInPicture();
      const rests = event('pause');
      media.remove();
      await rests;
      return media.paused;
    },
    expected: true,
  },
];

const reflected: readonly Row[] = [
  {
    test: '/html/dom/reflection-embedded.html#video.playsInline',
    ask: ({ make }) => {
      const media = make();
      const seen: unknown[] = [media.playsInline];
      media.setAttribute('playsinline', '');
      seen.push(media.playsInline);
      media.playsInline = false;
      return [...seen, media.hasAttribute('playsinline')];
    },
    expected: [false, true, false],
  },
];

export const theme: Theme = { name: 'picture', control: 'video', seen: true, rows: [...callbacks, ...pictures, ...streams, ...windows, ...shown, ...reflected] };
