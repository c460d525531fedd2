/** espeak-ng, an engine of formants for a hundred languages, in a worker of the page. */

import { isEnglish } from '../../../web/speech/english.js';
import type { SpeechSource } from '../../../web/speech/source.js';
import workerUrl from './worker.ts?worker&url';
import { openWorker } from '../../../web/speech/trusted.js';
import { WorkerSource } from '../../../web/speech/worker-source.js';

/** Variants that make other speakers of a language's one voice. */
const VARIANTS: Record<string, string> = { sofia: '+f2', amara: '+f3', lia: '+f4', papous: '+m4', kenji: '+m2' };

/** Shared source for all players of the page; pass it to `addSpeechSource`. */
export const espeak: SpeechSource = new WorkerSource({
  name: 'espeak-ng',
  about: 'A clear voice that sounds like a machine, of many languages.',
  license: 'GPL-3.0-or-later',
  // The built-in voices of the player speak English.
  speaks: (language) => !isEnglish(language),
  voiceOf(figure, language) {
    const tag = language.toLowerCase();
    return `${tag === 'pt-br' ? tag : tag.split('-')[0]}${VARIANTS[figure] ?? ''}`;
  },
  worker: () => openWorker(workerUrl, { folder: 'voices/espeak/' }),
});
