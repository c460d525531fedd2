/** Worker side: the baker's code finds the text to speak, and requests the audio from an engine utterance by utterance. */

import instantiate from '../pkg/say/raconteur.js';
import sayUrl from '../pkg/say/raconteur_bg.wasm?url';
import { fetchBytes, fetchModule, type Fetching, SCRIPT } from '../element/base/fetching.js';
import type { WorkerRequest, Part, Reply } from './messages.js';

/** Minimum interval between parts, ms; results in between are sent together. */
const BETWEEN_PARTS_MS = 1200;

/** Text being spoken; `crate/say`. */
interface PendingSpeech {
  take(): Part;
  free(): void;
}

interface Speaker {
  begin(eml: string, fragment: boolean, known: string | undefined): PendingSpeech;
  step(saying: PendingSpeech): boolean;
}

interface SpeechCommand {
  (source: { module_or_path: WebAssembly.Module }): Promise<unknown>;
  Speaker: new (engine: string, host: object, voice: string) => Speaker;
  panicMessage(): string | undefined;
}

/** Environment of an engine for `crate/say`, in addition to the functions called by `hosts.rs`. */
export interface Host {
  /** Returns a promise for the pending request that settles when it succeeds or fails. Synchronous engines have nothing pending. */
  pending(): Promise<unknown> | undefined;
  /** Cancels the pending request. */
  forget?(): void;
}

const post = (reply: Reply, transfer: Transferable[] = []) => self.postMessage(reply, { transfer });

/** Reports the download progress to the page. */
export const progress = (share: number): void => post({ kind: 'progress', share });

/** Maximum size of a file of a voice, bytes: the models of natural ones have some hundred MB. */
const MAX_BYTES = 1e9;

/** Options for fetching a voice file. */
export const voiceFile: Fetching = { what: 'The voice', most: MAX_BYTES, progress };

/** Fetches a file and reports its progress. */
export async function fetched(url: URL): Promise<Response> {
  return new Response(await fetchBytes(url, voiceFile));
}

/** Yields to incoming messages. */
const breath = (): Promise<void> => new Promise((done) => setTimeout(done));

/** Speaks with an engine of `crate/say`, which `open` fetches at the first text. */
export function serve(engine: string, open: () => Promise<Host>): void {
  let opening: Promise<{ say: SpeechCommand; host: Host }> | undefined;
  let say: SpeechCommand | undefined;
  const speakers = new Map<string, Speaker>();
  const stopped = new Set<number>();
  /** Ends the wait of the current text. */
  let stop: (() => void) | undefined;
  let last: Promise<void> = Promise.resolve();

  const both = async () => {
    const made = instantiate() as unknown as SpeechCommand;
    const { what, most } = voiceFile;
    const [host, module] = await Promise.all([open(), fetchModule(new URL(sayUrl, SCRIPT), { what, most })]);
    await made({ module_or_path: module });
    progress(1);
    say = made;
    return { say: made, host };
  };

  const speak = async ({ id, eml, fragment = false, known, voice }: Extract<WorkerRequest, { kind: 'speak' }>): Promise<void> => {
    const { say, host } = await (opening ??= both());
    let speaker = speakers.get(voice);
    if (speaker === undefined) speakers.set(voice, (speaker = new say.Speaker(engine, host, voice)));
    const saying = speaker.begin(eml, fragment, known);
    const send = () => {
      const part = saying.take();
      post(
        { kind: 'part', id, ...part },
        part.sounds.map(([, wave]) => wave.buffer as ArrayBuffer),
      );
    };
    try {
      let sentMs = -Infinity;
      let unsent = true;
      while (!stopped.has(id) && speaker.step(saying)) {
        const wanted = host.pending();
        if (wanted !== undefined) {
          // A cancelled request does not delay the next text.
          await Promise.race([wanted, new Promise<void>((done) => (stop = done))]);
          if (stopped.has(id)) host.forget?.();
          continue;
        }
        unsent = true;
        if (performance.now() - sentMs > BETWEEN_PARTS_MS) {
          send();
          sentMs = performance.now();
          unsent = false;
        }
        await breath();
      }
      if (unsent && !stopped.has(id)) send();
    } finally {
      saying.free();
    }
    post({ kind: 'done', id });
  };

  self.onmessage = ({ data }: MessageEvent<WorkerRequest>) => {
    if (data.kind === 'stop') {
      stopped.add(data.id);
      stop?.();
      return;
    }
    last = last.then(async () => {
      try {
        if (!stopped.has(data.id)) await speak(data);
      } catch (error) {
        const trapped = error instanceof WebAssembly.RuntimeError;
        const panic = trapped ? say?.panicMessage() : undefined;
        const message = panic ?? (error instanceof Error ? error.message : String(error));
        post({ kind: 'failed', id: data.id, message, dead: say === undefined || trapped });
      }
      stopped.delete(data.id);
    });
  };
}
