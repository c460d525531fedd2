/** Storage of the annotation, which survives a reload and the end of the browser. A recording is not stored. */

import { StoredText } from '../stored-text.js';
import type { Transcription } from './types.js';

const annotation = new StoredText('raconteur.transcribe', () => localStorage);

export interface Remembered {
  /** Name of the file, without its ending. */
  readonly name: string;
  readonly transcription: Transcription;
}

/** Stores an annotation; false if the browser has no space for it. */
export function remember(value: Remembered): boolean {
  return annotation.set(JSON.stringify(value));
}

export function remembered(): Remembered | undefined {
  const text = annotation.get();
  try {
    return text === undefined ? undefined : (JSON.parse(text) as Remembered);
  } catch {
    return undefined;
  }
}

export function forget(): void {
  annotation.forget();
}
