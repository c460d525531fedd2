/**
 * Playback as defined for a media element (HTML, section 4.8.11.8 “Playing the media resource”): `paused` changes immediately, and the promise of `play()` is
 * resolved when playback starts and rejected by `pause()`, `load()` or an error.
 */

import type { Permission } from '../sound/outlet.js';
import type { Transport } from './transport.js';

/** Playback events without a story; with one, the transport sends them. */
export type PlaybackEvent = 'play' | 'waiting' | 'pause';

interface Pending {
  resolve(): void;
  reject(error: DOMException): void;
}

/** Requested playback state, and the promises that depend on it. */
export class Playback {
  readonly #permission: Permission;
  readonly #emit: (event: PlaybackEvent) => unknown;
  readonly #ensure: () => void;
  readonly #after: (work: () => void) => void;
  #transport: Transport | undefined;
  #wanted = false;
  #pending: Pending[] = [];
  /** Changes when earlier calls are settled. */
  #turn = {};
  /** The attribute `autoplay` counts: neither `play` nor `pause` was called since loading began. */
  mayAutoplay = true;

  /** Creates the state; `ensure` starts to load missing parts, and must not throw; `after` runs an action after the pending events. */
  constructor(permission: Permission, emit: (event: PlaybackEvent) => unknown, ensure: () => void, after: (work: () => void) => void) {
    this.#permission = permission;
    this.#emit = emit;
    this.#ensure = ensure;
    this.#after = after;
  }

  get paused(): boolean {
    return this.#transport?.paused ?? !this.#wanted;
  }

  /** Starts playback; resolves when it has started. */
  play(): Promise<void> {
    this.mayAutoplay = false;
    const kept = new Promise<void>((resolve, reject) => this.#pending.push({ resolve, reject }));
    const turn = this.#turn;
    // Within the click: some browsers start sound only from there.
    const woken = this.#permission.wake();
    if (this.#permission.likely) this.#begin();
    this.#ensure();
    void woken.then((allowed) => {
      if (turn !== this.#turn) return;
      if (allowed) this.#begin();
      else this.#refuse();
    });
    return kept;
  }

  pause(): void {
    this.mayAutoplay = false;
    this.#rest();
    this.#breakAfter('AbortError', 'The call of play() was interrupted by a call of pause().');
  }

  /** Attaches the transport of a story, and plays it if that was requested. */
  attach(transport: Transport): void {
    this.#transport = transport;
    if (this.#wanted) transport.play(true);
  }

  /** Detaches an unloaded or cancelled story: promises are rejected, and no `pause` is dispatched. */
  detach(): void {
    this.#transport = undefined;
    this.#wanted = false;
    this.mayAutoplay = true;
    reject(this.#settle(), 'AbortError', 'The call of play() was interrupted by a new load.');
  }

  /** Reports that there is no story to play. */
  fail(message: string): void {
    this.#breakAfter('NotSupportedError', message);
  }

  /** Resolves pending promises, because the audio has begun. */
  started(): void {
    const pending = this.#settle();
    this.#after(() => {
      for (const { resolve } of pending) resolve();
    });
  }

  #begin(): void {
    const transport = this.#transport;
    if (transport !== undefined) {
      if (transport.paused) transport.play();
      else if (!transport.waiting) this.started();
    } else if (!this.#wanted) {
      this.#emit('play');
      this.#emit('waiting');
    }
    this.#wanted = true;
  }

  #rest(): void {
    const transport = this.#transport;
    if (transport !== undefined) transport.pause();
    else if (this.#wanted) this.#emit('pause');
    this.#wanted = false;
  }

  #refuse(): void {
    this.#rest();
    this.#breakAfter('NotAllowedError', 'The browser allows sound only after the user has done something.');
  }

  /** Rejects the promises after the pending events have been dispatched. */
  #breakAfter(name: string, message: string): void {
    const pending = this.#settle();
    this.#after(() => reject(pending, name, message));
  }

  #settle(): Pending[] {
    this.#turn = {};
    const pending = this.#pending;
    this.#pending = [];
    return pending;
  }
}

function reject(pending: readonly Pending[], name: string, message: string): void {
  for (const { reject } of pending) reject(new DOMException(message, name));
}
