/** Speech worker with a server; the worker's name contains its address and voices. */

import { fetchText } from '../element/base/fetching.js';
import { DeferredAnswers } from './deferred-answers.js';
import { type Host, serve } from './serve.js';

/** A sentence with its sound: `Answer` of `crate/voice`. */
interface Answer {
  readonly sound: Uint8Array;
  readonly times: string;
}

/** Timeout of a server that sends no data while it speaks, ms. */
const PATIENCE_MS = 30_000;
/** Maximum size of an answer, bytes: a sentence of several minutes as uncompressed samples. */
const MAX_BYTES = 64e6;

class Server implements Host {
  readonly #url: string;
  readonly #voices: string;
  readonly #answers = new DeferredAnswers<Answer>();

  constructor({ url, voices }: { url: string; voices: unknown }) {
    this.#url = url;
    this.#voices = JSON.stringify(voices);
  }

  voices(): string {
    return this.#voices;
  }

  pending(): Promise<void> | undefined {
    return this.#answers.pending();
  }

  /** Returns the server's answer to a request; undefined until it arrives. */
  ask(request: string): Answer | undefined {
    return this.#answers.ask(request, (signal) => this.#post(request, signal));
  }

  forget(): void {
    this.#answers.forget();
  }

  async #post(body: string, signal: AbortSignal): Promise<Answer> {
    const request = { method: 'POST', headers: { 'content-type': 'application/json' }, body };
    const answer = await fetchText(new URL(this.#url), { what: 'The sound of the voice', most: MAX_BYTES, signal, silenceMs: PATIENCE_MS, request });
    const { sound, times } = JSON.parse(answer) as { sound?: unknown; times?: unknown };
    if (typeof sound !== 'string' || typeof times !== 'string') throw new Error('the server of the voice answers without sound or times');
    return { sound: Uint8Array.from(atob(sound), (byte) => byte.charCodeAt(0)), times };
  }
}

serve('server', () => Promise.resolve(new Server(JSON.parse(self.name) as ConstructorParameters<typeof Server>[0])));
