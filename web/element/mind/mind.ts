/** A mind: EML in by WebSocket, events out as JSON. Fetched only by players that have one. */

import type { MindEvent, Note } from '../base/mind-events.js';
import type { Answer } from '../base/performance.js';
import type { Diagnostic, MindState } from '../base/types.js';

/** Maximum length of a message; the engine accepts a quarter of it. */
const MAX_CHARACTERS = 65_536;
/** Fragments refused for their pace, one after another, after which the connection is closed. */
const MAX_REFUSED = 100;
/** Amount of unsent data, because the mind does not read, above which events are dropped and counted. */
const MAX_UNREAD_BYTES = 1_000_000;
/** Waits before connecting again: the first, and the longest; each is twice the one before. */
const WAIT_MS = { first: 500, longest: 30_000 };
/** Duration after which a connection counts as stable, and the reconnection delay is reset. */
const STEADY_MS = 5_000;
/** The performance stays open-ended for so long after a mind was lost, or first called. */
const GRACE_MS = 30_000;

/** Player, as seen by a mind. */
export interface MindHost {
  hello(): { timeSecs: number; endSecs: number; figure: string };
  /** Performs a fragment immediately, or later if it must be spoken first. */
  perform(fragment: string): readonly Answer[] | Promise<readonly Answer[]>;
  /** Returns true if a message ends fragments. */
  interrupts(message: string): boolean;
  /** Returns a signal that aborts when fragments are next interrupted. */
  turn(): AbortSignal;
  /** Returns the answer about a fragment that was waiting at the interruption. */
  dropped(): readonly Answer[];
  report(diagnostic: Diagnostic): void;
  state(state: MindState): void;
}

/** Connection to one mind, with automatic reconnection. */
export class MindLink {
  readonly #url: URL;
  readonly #host: MindHost;
  #socket: WebSocket | undefined;
  #timer: ReturnType<typeof setTimeout> | undefined;
  #failures = 0;
  #refused = 0;
  #lost = 0;
  #openedMs = 0;
  /** Time at which a mind was last connected, or first contacted. */
  #seenMs = performance.now();
  #closed = false;
  /** Number of fragments awaiting speech, and the last of them. */
  #speaking = 0;
  #spoken: Promise<void> = Promise.resolve();

  private constructor(url: URL, host: MindHost) {
    this.#url = url;
    this.#host = host;
  }

  /** Connects to a mind; returns undefined, with a diagnostic, if the address is invalid. */
  static open(address: string, host: MindHost): MindLink | undefined {
    const url = URL.canParse(address, document.baseURI) ? new URL(address, document.baseURI) : undefined;
    // An address relative to the page means its server.
    if (url?.protocol === 'https:' || url?.protocol === 'http:') url.protocol = url.protocol.replace('http', 'ws');
    if (url === undefined || !/^wss?:$/.test(url.protocol) || url.username !== '') {
      host.report({
        code: 'mind-address',
        severity: 'error',
        message: 'The address of the mind is not a WebSocket address.',
        hints: ['Write mind="wss://…", or a path on this server.'],
      });
      return undefined;
    }
    url.hash = '';
    const link = new MindLink(url, host);
    // The element must store the link before it receives events from it.
    link.#timer = setTimeout(() => link.#connect());
    return link;
  }

  /** True if a mind is connected, or was shortly before. */
  get listening(): boolean {
    return this.#socket?.readyState === WebSocket.OPEN || performance.now() - this.#seenMs < GRACE_MS;
  }

  /** Sends an event to the mind, if it is connected and reads. */
  send(event: MindEvent): void {
    const socket = this.#socket;
    if (socket?.readyState !== WebSocket.OPEN) return;
    if (socket.bufferedAmount > MAX_UNREAD_BYTES) {
      this.#lost += 1;
      return;
    }
    if (this.#lost > 0) socket.send(JSON.stringify({ kind: 'lost', count: this.#lost } satisfies Note));
    this.#lost = 0;
    socket.send(JSON.stringify(event));
  }

  close(): void {
    this.#closed = true;
    clearTimeout(this.#timer);
    this.#seenMs = -Infinity;
    this.#socket?.close(1000);
    this.#socket = undefined;
  }

  #connect(): void {
    this.#host.state('connecting');
    let socket: WebSocket;
    try {
      socket = new WebSocket(this.#url);
    } catch {
      // A page fetched by https may not use ws:.
      this.#again();
      return;
    }
    this.#socket = socket;
    socket.onopen = () => {
      this.#openedMs = performance.now();
      this.#refused = 0;
      this.send({ kind: 'hello', version: 1, ...this.#host.hello() });
      this.#host.state('open');
    };
    socket.onmessage = ({ data }) => this.#hear(socket, data);
    socket.onclose = () => {
      if (this.#closed) return;
      if (this.#openedMs > 0) {
        this.#seenMs = performance.now();
        if (this.#seenMs - this.#openedMs > STEADY_MS && this.#refused < MAX_REFUSED) this.#failures = 0;
      }
      this.#again();
    };
  }

  /** Reconnects after a delay that doubles each time, with random jitter against simultaneous reconnection of many players. */
  #again(): void {
    this.#socket = undefined;
    if (this.#openedMs > 0 || this.#failures === 0) {
      this.#host.report({
        code: 'mind-lost',
        severity: 'warning',
        message: `There is no connection to the mind at ${this.#url.host}.`,
        hints: ['The player retries automatically.'],
      });
    }
    this.#openedMs = 0;
    const wait = Math.min(WAIT_MS.longest, WAIT_MS.first * 2 ** this.#failures) * (0.5 + Math.random() / 2);
    this.#failures += 1;
    this.#host.state('closed');
    this.#timer = setTimeout(() => this.#connect(), wait);
  }

  #hear(socket: WebSocket, data: unknown): void {
    // Messages that arrived before the connection closed.
    if (socket !== this.#socket || socket.readyState !== WebSocket.OPEN) return;
    if (typeof data !== 'string' || data.length > MAX_CHARACTERS) {
      socket.close(typeof data === 'string' ? 4009 : 4003);
      return;
    }
    // Messages are performed in order of arrival, but an interruption does not wait.
    const turn = this.#host.turn();
    const later = () => (turn.aborted ? this.#host.dropped() : this.#host.perform(data));
    const interrupts = this.#host.interrupts(data);
    if (interrupts) this.#spoken = Promise.resolve();
    const waits = this.#speaking > 0 && !interrupts;
    const answers = waits ? this.#spoken.then(later) : this.#host.perform(data);
    if (!(answers instanceof Promise)) {
      this.#answer(socket, answers);
      return;
    }
    this.#speaking += 1;
    if (this.#speaking > MAX_REFUSED) socket.close(4008);
    this.#spoken = answers.then((all) => {
      this.#speaking -= 1;
      if (socket === this.#socket) this.#answer(socket, all);
    });
  }

  #answer(socket: WebSocket, answers: readonly Answer[]): void {
    this.#refused = answers.some((a) => a.kind === 'failed' && a.code === 'live::busy') ? this.#refused + 1 : 0;
    // Other problems were reported as cues.
    for (const answer of answers) if (answer.kind === 'accepted' || answer.code === 'live::interrupted') this.send(answer);
    if (this.#refused >= MAX_REFUSED) socket.close(4008);
  }
}
