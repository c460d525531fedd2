/** Speaks by a server; the worker's name tells where that is and which voices it has. */

import { type Host, serve } from './serve.js';

/** A sentence with its sound: `Answer` of `crate/voice`. */
interface Answer {
  readonly sound: Uint8Array;
  readonly times: string;
}

/** A server that does not answer for so long will not, ms. */
const PATIENCE_MS = 30_000;
/** Answers are kept for sentences that are asked for again, because others of their utterance were not there yet. */
const MOST_KEPT = 32;

class Server implements Host {
  readonly #url: string;
  readonly #voices: string;
  readonly #answers = new Map<string, Answer>();
  #pending: Promise<void> | undefined;
  #failure: unknown;

  constructor({ url, voices }: { url: string; voices: unknown }) {
    this.#url = url;
    this.#voices = JSON.stringify(voices);
  }

  voices(): string {
    return this.#voices;
  }

  pending(): Promise<void> | undefined {
    return this.#pending;
  }

  /** What the server says to a request; undefined until it answers. */
  ask(request: string): Answer | undefined {
    const failure = this.#failure;
    this.#failure = undefined;
    if (failure !== undefined) throw failure;
    const known = this.#answers.get(request);
    if (known !== undefined) return known;
    this.#pending = this.#post(request)
      .catch((error: unknown) => {
        this.#failure = error;
      })
      .finally(() => {
        this.#pending = undefined;
      });
    return undefined;
  }

  async #post(request: string): Promise<void> {
    const response = await fetch(this.#url, { method: 'POST', headers: { 'content-type': 'application/json' }, body: request, signal: AbortSignal.timeout(PATIENCE_MS) });
    if (!response.ok) throw new Error(`the server of the voice answers ${response.status}`);
    const { sound, times } = (await response.json()) as { sound?: unknown; times?: unknown };
    if (typeof sound !== 'string' || typeof times !== 'string') throw new Error('the server of the voice answers without sound or times');
    this.#answers.set(request, { sound: Uint8Array.from(atob(sound), (byte) => byte.charCodeAt(0)), times });
    const [oldest] = this.#answers.keys();
    if (this.#answers.size > MOST_KEPT && oldest !== undefined) this.#answers.delete(oldest);
  }
}

serve('server', () => Promise.resolve(new Server(JSON.parse(self.name) as ConstructorParameters<typeof Server>[0])));
