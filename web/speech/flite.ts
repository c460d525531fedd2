/** flite, a small engine of American English, in a worker of the page. */

import type { Said, Saying, SpeechRequest, SpeechSource } from './source.js';

/** To the worker. */
export interface Ask extends SpeechRequest {
  readonly id: number;
}

/** From the worker. */
export type Reply =
  | { readonly kind: 'progress'; readonly share: number }
  | { readonly kind: 'said'; readonly id: number; readonly bundle: string; readonly sounds: readonly (readonly [string, Uint8Array])[]; readonly problems: readonly string[] }
  /** `dead`: the worker cannot be used again. */
  | { readonly kind: 'failed'; readonly id: number; readonly message: string; readonly dead: boolean };

/** Nothing that a person waits for takes longer; a worker that does hangs. The first time what it needs is fetched. */
const PATIENCE_MS = { first: 120_000, usual: 30_000 } as const;

/** A woman's, two men's and a Scot's. */
const VOICES: Record<string, string> = { papous: 'rms', kenji: 'kal16', nuno: 'awb' };
const USUAL = 'slt';

interface Waiting {
  readonly resolve: (said: Said) => void;
  readonly reject: (why: unknown) => void;
  readonly progress: (share: number) => void;
}

class Flite implements SpeechSource {
  readonly name = 'flite';
  #worker: Worker | undefined;
  #ready = false;
  #next = 0;
  readonly #waiting = new Map<number, Waiting>();

  get ready(): boolean {
    return this.#ready;
  }

  speaks(language: string): boolean {
    return /^en\b/i.test(language);
  }

  voiceOf(figure: string): string {
    return VOICES[figure] ?? USUAL;
  }

  async speak(request: SpeechRequest, { signal, progress }: Saying): Promise<Said> {
    signal.throwIfAborted();
    const worker = this.#open();
    const id = this.#next++;
    const patience = this.#ready ? PATIENCE_MS.usual : PATIENCE_MS.first;
    let timer: ReturnType<typeof setTimeout> | undefined;
    const stop = () => this.#waiting.get(id)?.reject(signal.reason);
    signal.addEventListener('abort', stop, { once: true });
    try {
      return await new Promise<Said>((resolve, reject) => {
        this.#waiting.set(id, { resolve, reject, progress });
        timer = setTimeout(() => this.#end('The voice does not answer.'), patience);
        worker.postMessage({ ...request, id } satisfies Ask);
      });
    } finally {
      clearTimeout(timer);
      signal.removeEventListener('abort', stop);
      this.#waiting.delete(id);
    }
  }

  #open(): Worker {
    if (this.#worker !== undefined) return this.#worker;
    const worker = new Worker(new URL('./flite-worker.ts', import.meta.url), { type: 'module' });
    worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#hear(data);
    worker.onerror = () => this.#end('The voice could not be started.');
    this.#worker = worker;
    return worker;
  }

  #hear(reply: Reply): void {
    if (reply.kind === 'progress') {
      for (const { progress } of this.#waiting.values()) progress(reply.share);
      return;
    }
    const waiting = this.#waiting.get(reply.id);
    if (reply.kind === 'failed') {
      waiting?.reject(new Error(reply.message));
      if (reply.dead) this.#end(reply.message);
      return;
    }
    this.#ready = true;
    const { bundle, sounds, problems } = reply;
    waiting?.resolve({ bundle, sounds: new Map(sounds), problems });
  }

  /** The next text gets a fresh worker. */
  #end(message: string): void {
    this.#worker?.terminate();
    this.#worker = undefined;
    this.#ready = false;
    for (const { reject } of this.#waiting.values()) reject(new Error(message));
  }
}

/** One for all players of the page. */
export const flite: SpeechSource = new Flite();
