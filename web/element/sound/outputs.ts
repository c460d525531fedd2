/** Where else a player's picture and sound go: callbacks of frames, streams, and a window over other windows. */

import type { Voice } from './voice.js';

/** All of them of one player, and the size of its picture. */
export class Outputs {
  readonly frames = new FrameCallbacks();
  readonly capture = new Capture();
  readonly #window = new PictureInPicture(this.capture);
  #size = { width: 0, height: 0 };

  /** That of the picture, device pixels; 0 before there is one. */
  get size(): { readonly width: number; readonly height: number } {
    return this.#size;
  }

  /** Another canvas, voice or size may be there; whether the size is another. */
  follow(playing: Playing): boolean {
    this.capture.follow(playing);
    const { width = 0, height = 0 } = playing.canvas ?? {};
    if (width === this.#size.width && height === this.#size.height) return false;
    this.#size = { width, height };
    return true;
  }

  /** A picture of a moment was drawn, where there is a picture. */
  drawn(secs: number): void {
    if (this.#size.width > 0) this.frames.drawn(secs, this.#size);
  }

  /** Shows the picture in a window over all others; `tell` is told when it comes and goes. Rejects as a `<video>` does. */
  async openWindow(root: ShadowRoot, isDisabled: boolean, tell: (event: Event) => void): Promise<PictureInPictureWindow> {
    if (!document.pictureInPictureEnabled) throw new DOMException('This browser or page does not support picture-in-picture.', 'NotSupportedError');
    if (this.#size.width === 0) throw new DOMException('There is no picture yet.', 'InvalidStateError');
    if (isDisabled) throw new DOMException('The page disables it.', 'InvalidStateError');
    return await this.#window.open(root, tell);
  }
}

/** What was drawn, for `requestVideoFrameCallback`. */
type FrameCallback = (nowMs: number, frame: VideoFrameCallbackMetadata) => void;

/** Calls back once for the next picture (https://wicg.github.io/video-rvfc/). */
export class FrameCallbacks {
  #callbacks = new Map<number, FrameCallback>();
  /** Those that are being called. */
  #called = new Map<number, FrameCallback>();
  #last = 0;
  #frames = 0;

  /** How many pictures were drawn. */
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

  /** A picture of a moment was drawn. */
  drawn(secs: number, { width, height }: { readonly width: number; readonly height: number }): void {
    this.#frames += 1;
    if (this.#callbacks.size === 0) return;
    const now = performance.now();
    const frame = { presentationTime: now, expectedDisplayTime: now, width, height, mediaTime: secs, presentedFrames: this.#frames };
    this.#called = this.#callbacks;
    // Those that are asked for meanwhile wait for the next one.
    this.#callbacks = new Map();
    for (const callback of this.#called.values()) callback(now, frame);
    this.#called.clear();
  }
}

/** What plays now. */
interface Playing {
  readonly canvas: HTMLCanvasElement | undefined;
  readonly voice: Voice | undefined;
}

/**
 * Streams of picture and sound. They follow the player to its next canvas and its next story; those with sound, which pages
 * have asked for, end with the story (https://w3c.github.io/mediacapture-fromelement/).
 */
class Capture {
  readonly #streams: { readonly stream: MediaStream; readonly rate: number | undefined; readonly hasSound: boolean }[] = [];
  #playing: Playing = { canvas: undefined, voice: undefined };
  #isLive = true;

  /** A page has a stream whose tracks are not stopped. */
  get isTaken(): boolean {
    return this.#streams.some(({ stream, hasSound }) => hasSound && stream.active);
  }

  /** `rate`: at most so many pictures a second. */
  open(rate: number | undefined, hasSound: boolean): MediaStream {
    const stream = new MediaStream();
    this.#streams.push({ stream, rate, hasSound });
    this.#fill();
    return stream;
  }

  /** Another canvas or voice plays from now on. */
  follow(playing: Playing): void {
    if (playing.canvas === this.#playing.canvas && playing.voice === this.#playing.voice) return;
    for (const { stream } of this.#streams) empty(stream);
    this.#playing = playing;
    this.#fill();
  }

  /** The story plays, or has come to its end. */
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
      // Others may hear the voice, too.
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

/** A window over all others that shows the player's picture (https://w3c.github.io/picture-in-picture/). */
class PictureInPicture {
  #video: HTMLVideoElement | undefined;
  readonly #capture: Capture;

  constructor(capture: Capture) {
    this.#capture = capture;
  }

  /** Opens it; `root` belongs to the player, so that the document names the player as what is shown. Rejects as a `<video>` does. */
  async open(root: ShadowRoot, tell: (event: Event) => void): Promise<PictureInPictureWindow> {
    const video = (this.#video ??= makeVideo(root, this.#capture, tell));
    if (video.readyState < video.HAVE_METADATA) await new Promise((there) => video.addEventListener('loadedmetadata', there, { once: true }));
    return await video.requestPictureInPicture();
  }
}

function makeVideo(root: ShadowRoot, capture: Capture, tell: (event: Event) => void): HTMLVideoElement {
  const video = document.createElement('video');
  // It is only there for the window; the player itself is heard.
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
