/** Small stories with a voice, made by the tests: recordings are WAV, so that every sample is known. */

/** An utterance to be: its words, each a phone, of the same length. */
export interface Made {
  readonly text: string;
  readonly msec: number;
  /** Its sound, at `SAMPLE_RATE`; without it, silence. */
  readonly samples?: Float32Array;
  /** What its key is made of, when it is no plain text. */
  readonly key?: string;
}

/** Samples a second of the fixtures: what software plays on the test's machine, so that nothing is resampled. */
export const SAMPLE_RATE = 44_100;

/** The key of a plain text said by the story's own voice: FNV-1a, 64 bits. */
function keyOf(said: string): string {
  let hash = 0xcbf29ce484222325n;
  // No voice is named.
  for (const byte of [1, 0xff, ...Buffer.from(said, 'latin1')]) hash = BigInt.asUintN(64, (hash ^ BigInt(byte)) * 0x100000001b3n);
  return hash.toString(16).padStart(16, '0');
}

/** What stands for a file of the library that `voice-say` says. */
export function fileKey(path: string, kind: 'text' | 'sable' = 'text'): string {
  return `${kind}\xff\xfc\x01\x01${path}\xff`;
}

/** The files of a voice, by their names in `voice/`. */
export function voiceFiles(utterances: readonly Made[]): { [path: string]: string | Buffer } {
  const files: { [path: string]: string | Buffer } = {};
  const written = utterances.map(({ text, msec, samples, key }, i) => {
    const file = `u${i}.wav`;
    files[`voice/${file}`] = wav(samples ?? new Float32Array(Math.round((msec * SAMPLE_RATE) / 1000)));
    const words = text.split(' ');
    let start = 0;
    const rows = words.map((word, k) => {
      const row = [start, Buffer.byteLength(word), k, 1];
      start += Buffer.byteLength(word) + 1;
      return row;
    });
    const each = Math.floor(msec / words.length);
    const msecs = words.map((_, k) => (k === 0 ? msec - each * (words.length - 1) : each));
    const stands = keyOf(key ?? text);
    return { key: stands, content: stands, voice: 0, text, audio: [{ file, mime: 'audio/wav' }], words: rows, phones: words.map(() => 'aa').join(' '), msecs };
  });
  files['voice/speech.json'] = JSON.stringify({
    format: 'raconteur-speech',
    version: 2,
    voices: [{ engine: 'test 1', voice: 'v', language: 'en-GB', phone_set: 'mrpa' }],
    utterances: written,
  });
  return files;
}

/** One channel of 32-bit floats. */
function wav(samples: Float32Array): Buffer {
  const head = Buffer.alloc(44);
  const bytes = Buffer.from(samples.buffer, samples.byteOffset, samples.byteLength);
  head.write('RIFF', 0);
  head.writeUInt32LE(36 + bytes.length, 4);
  head.write('WAVEfmt ', 8);
  head.writeUInt32LE(16, 16);
  head.writeUInt16LE(3, 20);
  head.writeUInt16LE(1, 22);
  head.writeUInt32LE(SAMPLE_RATE, 24);
  head.writeUInt32LE(SAMPLE_RATE * 4, 28);
  head.writeUInt16LE(4, 32);
  head.writeUInt16LE(32, 34);
  head.write('data', 36);
  head.writeUInt32LE(bytes.length, 40);
  return Buffer.concat([head, bytes]);
}

/** A story whose body is `body`. */
export const story = (body: string): string => `<eml xmlns:r='urn:raconteur:eml:1'><body>${body}</body></eml>`;
