/** flite, a small engine of American English, in a worker of the page. */

import { isEnglish } from './english.js';
import type { SpeechSource } from './source.js';
import workerUrl from './flite-worker.ts?worker&url';
import { openWorker } from './trusted.js';
import { WorkerSource } from './worker-source.js';

/** A woman's, two men's and a Scot's. */
const VOICES: Record<string, string> = { papous: 'rms', kenji: 'kal16', nuno: 'awb' };
const USUAL = 'slt';

/** Speech source that uses flite, shared by all players of the page. */
export const flite: SpeechSource = new WorkerSource({
  name: 'flite',
  about: 'A small American voice that sounds like a machine.',
  license: 'MIT-Festival',
  speaks: isEnglish,
  voiceOf: (figure) => VOICES[figure] ?? USUAL,
  worker: () => openWorker(workerUrl, { folder: 'voices/flite/' }),
});
