/** Speaks by a server; the worker's name tells where that is and which voices it has. */

import { Later } from './later.js';
import { type Host, serve } from './serve.js';

/** A sentence with its sound: `Answer` of `crate/voice`. */
interface Answer {
  readonly sound: Uint8Array;
  readonly times: string;
}

/** A server that does not answer for so long will not, ms. */
const PATIENCE_MS = 30_000;

class Server implements Host {
  readonly #url: string;
  readonly #voices: string;
  readonly #answers = new Later<Answer>();

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

  /** What the server says to a request; undefined until it answers. */
  ask(request: string): Answer | undefined {
    return this.#answers.ask(request, () => this.#post(request));
  }

  async #post(request: string): Promise<Answer> {
    const response = await fetch(this.#url, { method: 'POST', headers: { 'content-type': 'application/json' }, body: request, signal: AbortSignal.timeout(PATIENCE_MS) });
    if (!response.ok) throw new Error(`the server of the voice answers ${response.status}`);
    const { sound, times } = (await response.json()) as { sound?: unknown; times?: unknown };
    if (typeof sound !== 'string' || typeof times !== 'string') throw new Error('the server of the voice answers without sound or times');
    return { sound: Uint8Array.from(atob(sound), (byte) => byte.charCodeAt(0)), times };
  }
}

serve('server', () => Promise.resolve(new Server(JSON.parse(self.name) as ConstructorParameters<typeof Server>[0])));
