/** Engine that speaks in a worker of the page. */

import type { WorkerRequest, Reply } from './messages.js';
import type { SpeechReceiver, SpeechRequest, SpeechSource } from './source.js';

/** Time limit of an utterance; a slower worker counts as hung. The initial data is fetched meanwhile, and its progress restarts the timer. */
const PATIENCE_MS = 60_000;

/** Engine: its description, its languages, and its worker. */
export interface Engine extends Pick<SpeechSource, 'name' | 'about' | 'license' | 'speaks' | 'voiceOf'> {
  worker(): Promise<Worker>;
}

interface Waiting extends SpeechReceiver {
  readonly resolve: () => void;
  readonly reject: (why: unknown) => void;
  timer?: ReturnType<typeof setTimeout>;
}

export class WorkerSource implements SpeechSource {
  readonly name: string;
  readonly about: string;
  readonly license: string;
  readonly #engine: Engine;
  #worker: Promise<Worker> | undefined;
  #ready = false;
  #next = 0;
  readonly #waiting = new Map<number, Waiting>();

  constructor(engine: Engine) {
    this.#engine = engine;
    ({ name: this.name, about: this.about, license: this.license } = engine);
  }

  get ready(): boolean {
    return this.#ready;
  }

  speaks(language: string): boolean {
    return this.#engine.speaks(language);
  }

  voiceOf(figure: string, language: string): string {
    return this.#engine.voiceOf(figure, language);
  }

  async speak(request: SpeechRequest, saying: SpeechReceiver): Promise<void> {
    const { signal } = saying;
    signal.throwIfAborted();
    const worker = await this.#open();
    signal.throwIfAborted();
    const id = this.#next++;
    const stop = () => {
      worker.postMessage({ kind: 'stop', id } satisfies WorkerRequest);
      this.#waiting.get(id)?.reject(signal.reason);
    };
    signal.addEventListener('abort', stop, { once: true });
    try {
      await new Promise<void>((resolve, reject) => {
        this.#waiting.set(id, { ...saying, resolve, reject });
        this.#wait();
        worker.postMessage({ ...request, kind: 'speak', id } satisfies WorkerRequest);
      });
    } finally {
      signal.removeEventListener('abort', stop);
      clearTimeout(this.#waiting.get(id)?.timer);
      this.#waiting.delete(id);
    }
  }

  /** Restarts the timer of all pending requests at each sign of life. */
  #wait(): void {
    for (const waiting of this.#waiting.values()) {
      clearTimeout(waiting.timer);
      waiting.timer = setTimeout(() => this.#end('The voice does not answer.'), PATIENCE_MS);
    }
  }

  #open(): Promise<Worker> {
    this.#worker ??= this.#engine.worker().then((worker) => {
      worker.onmessage = ({ data }: MessageEvent<Reply>) => this.#hear(data);
      worker.onerror = () => this.#end('The voice could not be started.');
      return worker;
    });
    this.#worker.catch(() => (this.#worker = undefined));
    return this.#worker;
  }

  #hear(reply: Reply): void {
    this.#wait();
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
    if (reply.kind === 'done') waiting?.resolve();
    else waiting?.take({ bundle: reply.bundle, sounds: new Map(reply.sounds), problems: reply.problems });
  }

  /** Ends the worker and rejects waiting texts with `message`; the next text gets a fresh worker. */
  #end(message: string): void {
    void this.#worker?.then((worker) => worker.terminate());
    this.#worker = undefined;
    this.#ready = false;
    for (const { reject } of this.#waiting.values()) reject(new Error(message));
  }
}
