/** Further outputs of a player's picture and audio: frame callbacks, streams, and a picture-in-picture window. */

import type { Voice } from './voice.js';

/** All outputs of one player, and the size of its picture. */
export class Outputs {
  readonly frames = new FrameCallbacks();
  readonly capture = new Capture();
  readonly #window = new PictureInPicture(this.capture);
  #size = { width: 0, height: 0 };

  /** Size of the picture, device pixels; 0 before there is one. */
  get size(): { readonly width: number; readonly height: number } {
    return this.#size;
  }

  /** Follows a change of canvas, voice or size; returns true if the size changed. */
  follow(playing: Playing): boolean {
    this.capture.follow(playing);
    const { width = 0, height = 0 } = playing.canvas ?? {};
    if (width === this.#size.width && height === this.#size.height) return false;
    this.#size = { width, height };
    return true;
  }

  /** Handles a rendered frame of a given time, if there is a picture. */
  drawn(secs: number): void {
    if (this.#size.width > 0) this.frames.drawn(secs, this.#size);
  }

  /** Shows the picture in a picture-in-picture window; `tell` is called when it opens and closes. Rejects like a `<video>`. */
  async openWindow(root: ShadowRoot, isDisabled: boolean, tell: (event: Event) => void): Promise<PictureInPictureWindow> {
    if (!document.pictureInPictureEnabled) throw new DOMException('This browser or page does not support picture-in-picture.', 'NotSupportedError');
    if (this.#size.width === 0) throw new DOMException('There is no picture yet.', 'InvalidStateError');
    if (isDisabled) throw new DOMException('The page disables it.', 'InvalidStateError');
    return await this.#window.open(root, tell);
  }
}

/** Callback of `requestVideoFrameCallback`, with the data of the frame. */
type FrameCallback = (nowMs: number, frame: VideoFrameCallbackMetadata) => void;

/** One-shot callbacks for the next frame (https://wicg.github.io/video-rvfc/). */
export class FrameCallbacks {
  #callbacks = new Map<number, FrameCallback>();
  /** Callbacks that are being called. */
  #called = new Map<number, FrameCallback>();
  #last = 0;
  #frames = 0;

  /** Number of rendered frames. */
  get count(): number {
    return this.#frames;
  }

  request(callback: FrameCallback): number {
    this.#last += 1;
    this.#callbacks.set(this.#last, callback);
    return this.#last;
  }

  cancel(handle: number): void {
    this.#callbacks.delete(handle);
    this.#called.delete(handle);
  }

  /** Handles a rendered frame of a given time. */
  drawn(secs: number, { width, height }: { readonly width: number; readonly height: number }): void {
    this.#frames += 1;
    if (this.#callbacks.size === 0) return;
    const now = performance.now();
    const frame = { presentationTime: now, expectedDisplayTime: now, width, height, mediaTime: secs, presentedFrames: this.#frames };
    this.#called = this.#callbacks;
    // Callbacks requested in the meantime wait for the next frame.
    this.#callbacks = new Map();
    for (const callback of this.#called.values()) callback(now, frame);
    this.#called.clear();
  }
}

/** Current playback resources. */
interface Playing {
  readonly canvas: HTMLCanvasElement | undefined;
  readonly voice: Voice | undefined;
}

/**
 * Streams of picture and audio. They follow the player to its next canvas and story; those with audio requested by pages end with the story
 * (https://w3c.github.io/mediacapture-fromelement/).
 */
class Capture {
  readonly #streams: { readonly stream: MediaStream; readonly rate: number | undefined; readonly hasSound: boolean }[] = [];
  #playing: Playing = { canvas: undefined, voice: undefined };
  #isLive = true;

  /** True if a page has a stream whose tracks are not stopped. */
  get isTaken(): boolean {
    return this.#streams.some(({ stream, hasSound }) => hasSound && stream.active);
  }

  /** Opens a stream. `rate`: the maximum frame rate. */
  open(rate: number | undefined, hasSound: boolean): MediaStream {
    const stream = new MediaStream();
    this.#streams.push({ stream, rate, hasSound });
    this.#fill();
    return stream;
  }

  /** Connects the streams to another canvas or voice. */
  follow(playing: Playing): void {
    if (playing.canvas === this.#playing.canvas && playing.voice === this.#playing.voice) return;
    for (const { stream } of this.#streams) empty(stream);
    this.#playing = playing;
    this.#fill();
  }

  /** Switches the streams when the story starts or reaches its end. */
  setLive(isLive: boolean): void {
    if (isLive === this.#isLive) return;
    this.#isLive = isLive;
    for (const { stream, hasSound } of this.#streams) if (!isLive && hasSound) empty(stream);
    this.#fill();
  }

  #fill(): void {
    const { canvas, voice } = this.#playing;
    for (const { stream, rate, hasSound } of this.#streams) {
      if (stream.getTracks().length > 0 || (hasSound && !this.#isLive)) continue;
      for (const track of canvas?.captureStream(rate).getTracks() ?? []) stream.addTrack(track);
      const sound = hasSound ? voice?.track() : undefined;
      // Other outputs may use the voice, too.
      if (sound !== undefined) stream.addTrack(sound.clone());
    }
  }
}

function empty(stream: MediaStream): void {
  for (const track of stream.getTracks()) {
    track.stop();
    stream.removeTrack(track);
  }
}

/** Picture-in-picture window of the player (https://w3c.github.io/picture-in-picture/). */
class PictureInPicture {
  #video: HTMLVideoElement | undefined;
  readonly #capture: Capture;

  constructor(capture: Capture) {
    this.#capture = capture;
  }

  /** Opens the window; `root` belongs to the player, so that the document reports the player as the picture-in-picture element. Rejects like a `<video>`. */
  async open(root: ShadowRoot, tell: (event: Event) => void): Promise<PictureInPictureWindow> {
    const video = (this.#video ??= makeVideo(root, this.#capture, tell));
    if (video.readyState < video.HAVE_METADATA) await new Promise((there) => video.addEventListener('loadedmetadata', there, { once: true }));
    return await video.requestPictureInPicture();
  }
}

function makeVideo(root: ShadowRoot, capture: Capture, tell: (event: Event) => void): HTMLVideoElement {
  const video = document.createElement('video');
  // The video exists only for the window; the player itself is audible.
  Object.assign(video, { muted: true, playsInline: true, srcObject: capture.open(undefined, false) });
  video.className = 'pip';
  video.setAttribute('aria-hidden', 'true');
  root.append(video);
  void video.play().catch(() => undefined);
  for (const type of ['enterpictureinpicture', 'leavepictureinpicture']) {
    video.addEventListener(type, (event) => {
      const { pictureInPictureWindow } = event as PictureInPictureEvent;
      tell(new PictureInPictureEvent(type, { bubbles: true, pictureInPictureWindow }));
    });
  }
  return video;
}
