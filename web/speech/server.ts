/** Speech server chosen by the page's owner (docs/voices.md, “A server”). */

import type { SpeechSource } from './source.js';
import workerUrl from './server-worker.ts?worker&url';
import { openWorker } from './trusted.js';
import { WorkerSource } from './worker-source.js';

/** A voice of a server. */
export interface ServerVoice {
  readonly name: string;
  /** A tag of BCP 47. */
  readonly language: string;
  readonly gender?: 'female' | 'male';
  /** Phone set, if the times do not specify it: `radio`, `mrpa`, `sampa`, `espeak`, … */
  readonly phoneSet?: string;
}

export interface SpeechServer {
  /** Address of the server, of the page's own origin or one that the page's policy names in `connect-src`. */
  readonly url: string;
  readonly name: string;
  readonly about: string;
  readonly license: string;
  /** Voices; the first one for each language is the default. */
  readonly voices: readonly ServerVoice[];
  /** The voices of figures, by their names. */
  readonly figures?: Readonly<Record<string, string>>;
}

const primary = (tag: string): string => tag.toLowerCase().split('-')[0] ?? '';

export function server({ url, voices, figures = {}, ...about }: SpeechServer): SpeechSource {
  const of = (language: string) => voices.filter((voice) => primary(voice.language) === primary(language));
  const name = JSON.stringify({ url: new URL(url, document.baseURI).href, voices });
  return new WorkerSource({
    ...about,
    speaks: (language) => of(language).length > 0,
    voiceOf(figure, language) {
      const able = of(language);
      return (able.find((voice) => voice.name === figures[figure]) ?? able[0])?.name ?? '';
    },
    worker: () => openWorker(workerUrl, { name }),
  });
}
