/**
 * Fetching with limits on size and silence. The size is counted as data arrive, whatever the server declares; the time limit applies to silence, so a slow
 * network is accepted.
 */

import { common } from './common.js';
import { PlayerError } from './types.js';

/** Receives the share of completed work, 0 to 1. */
export type Progress = (share: number) => void;

/** Time without data after which a request fails, milliseconds. */
const SILENCE_MS = 20_000;

/** Destinations of credentials such as cookies: no other origin, unless the page's `crossorigin` allows it. */
export type Credentials = 'same-origin' | 'include';

/** Description and limits of a request. */
export interface Fetching {
  /** Description of the resource, for the beginning of a sentence. */
  readonly what: string;
  /** Maximum number of bytes to read. */
  readonly most: number;
  /** Signal that aborts the request. */
  readonly signal?: AbortSignal | undefined;
  readonly progress?: Progress | undefined;
  /** Time without data after which the request fails, milliseconds. */
  readonly silenceMs?: number;
  readonly credentials?: Credentials | undefined;
  readonly request?: Omit<RequestInit, 'signal' | 'credentials'>;
}

/** Error returned when a resource is not available; the message is a sentence with the address. */
export class FetchError extends PlayerError {}

/** Error returned when a file does not exist. */
class MissingError extends FetchError {}

/** Returns an address for display. */
export const shown = (url: URL): string => (url.origin === globalThis.location?.origin ? url.pathname : url.href);

/** Returns the error for a resource that is too large, before or while it is read. */
export const tooLarge = (what: string, most: number): FetchError => new FetchError(`${what} is larger than ${Math.round(most / 1e6)} MB and was not read.`);

/** Timer that detects a stalled request. */
class StallTimer {
  readonly #url: URL;
  readonly #fetching: Fetching;
  readonly #abort = new AbortController();
  readonly #stop = () => this.#abort.abort();
  #timer: ReturnType<typeof setTimeout> | undefined;
  /** Reason why it was ended here. */
  #why: FetchError | undefined;

  constructor(url: URL, fetching: Fetching) {
    this.#url = url;
    this.#fetching = fetching;
    fetching.signal?.addEventListener('abort', this.#stop, { once: true });
  }

  async open(): Promise<Response> {
    const { what, signal, credentials = 'same-origin', request } = this.#fetching;
    signal?.throwIfAborted();
    this.#listen();
    const response = await fetch(this.#url, { ...request, credentials, signal: this.#abort.signal });
    if (response.status === 404) throw this.missing();
    if (!response.ok) throw this.#end(new FetchError(`${what} could not be fetched from ${shown(this.#url)}: the server answered ${response.status}.`));
    return response;
  }

  /** Reads to the end, or to the limit. */
  async read({ headers, body }: Response, take: (chunk: Uint8Array) => void): Promise<void> {
    const { what, most, progress } = this.#fetching;
    const expected = Number(headers.get('content-length')) || 0;
    if (expected > most) throw this.#end(tooLarge(what, most));
    let length = 0;
    const reader = body?.getReader();
    while (reader !== undefined) {
      this.#listen();
      const { done, value } = await reader.read();
      if (done) break;
      length += value.length;
      if (length > most) throw this.#end(tooLarge(what, most));
      take(value);
      // The length counts compressed bytes, so it may be passed.
      if (expected > 0) progress?.(Math.min(1, length / expected));
    }
    progress?.(1);
  }

  /** Returns the meaning of an error. */
  reason(error: unknown): unknown {
    const { what, signal } = this.#fetching;
    if (signal?.aborted) return signal.reason;
    // The received data has the wrong format.
    if (error instanceof WebAssembly.CompileError) return error;
    return this.#why ?? new FetchError(`${what} could not be fetched from ${shown(this.#url)}: is the network available?`, { cause: error });
  }

  close(): void {
    clearTimeout(this.#timer);
    this.#fetching.signal?.removeEventListener('abort', this.#stop);
  }

  #listen(): void {
    const { what, silenceMs = SILENCE_MS } = this.#fetching;
    clearTimeout(this.#timer);
    const silent = () => this.#end(new FetchError(`${what} could not be fetched from ${shown(this.#url)}: no data for ${Math.round(silenceMs / 1000)} seconds.`));
    this.#timer = setTimeout(silent, silenceMs);
  }

  /** Ends the request because the file does not exist. */
  missing(): FetchError {
    return this.#end(new MissingError(`${this.#fetching.what} was not found at ${shown(this.#url)}.`));
  }

  #end(why: FetchError): FetchError {
    this.#why ??= why;
    this.#stop();
    return why;
  }
}

async function watched<T>(url: URL, fetching: Fetching, work: (watch: StallTimer) => Promise<T>): Promise<T> {
  const watch = new StallTimer(url, fetching);
  try {
    return await work(watch);
  } catch (error) {
    throw watch.reason(error);
  } finally {
    watch.close();
  }
}

/** Fetches the bytes at an address. Throws a `FetchError`, or the signal's reason. */
export async function fetchBytes(url: URL, fetching: Fetching): Promise<Uint8Array<ArrayBuffer>> {
  return await watched(url, fetching, async (watch) => {
    const chunks: Uint8Array[] = [];
    await watch.read(await watch.open(), (chunk) => chunks.push(chunk));
    return joined(chunks);
  });
}

/** Does the same as `fetchBytes`, and returns text. */
export async function fetchText(url: URL, fetching: Fetching): Promise<string> {
  return new TextDecoder().decode(await fetchBytes(url, fetching));
}

// Classic scripts have no such address.
if ((import.meta.url as string | undefined) === undefined) {
  throw new PlayerError('The player was built as a script without an address of its own: build it as a module (esbuild: --format=esm).');
}

/** True if the script's address is a file on the machine that built the page. Some bundlers write that path here, and resolve addresses from the page's. */
const isPlaceOfBuild = import.meta.url.startsWith('file:') && !(globalThis.location?.protocol ?? 'file:').startsWith('file:');

/**
 * Address of this script, for addresses of files that a build has made. It has another name than the module's own: bundlers treat `new URL(…,
 * import.meta.url)` as a file of the page that they build.
 */
export const SCRIPT = isPlaceOfBuild ? globalThis.location.href : import.meta.url;

/** Alternative location of files missing next to the script: folders of the library. A page's own build may have omitted them. */
export const spare = common<{ library?: URL }>('spare', () => ({}));

/** The player's files, in the library. */
const PLAYER = 'player/';

/** Returns the address of a folder's file in the library. */
const spareOf = ({ pathname }: URL, library: URL, folder: string): URL => new URL(`${folder}${pathname.split('/').at(-1) ?? ''}`, library);

/** Fetches a module like `fetchBytes`; compiled as it arrives, if the server declares it as wasm. */
export async function fetchModule(url: URL, fetching: Fetching): Promise<WebAssembly.Module> {
  try {
    return await compiled(url, fetching);
  } catch (error) {
    if (!(error instanceof MissingError) || spare.library === undefined) throw error;
    return await compiled(spareOf(url, spare.library, PLAYER), fetching).catch(() => {
      throw error;
    });
  }
}

/** Returns the address of a script that the browser itself fetches: next to this one, else in a folder of the library. */
export async function placeOf(url: URL, folder = PLAYER): Promise<URL> {
  const { library } = spare;
  if (library === undefined) return url;
  // Application servers return their page for missing files.
  const isThere = await fetch(url, { method: 'HEAD' }).then(
    ({ status, headers }) => status !== 404 && !headers.get('content-type')?.startsWith('text/html'),
    () => true,
  );
  return isThere ? url : spareOf(url, library, folder);
}

async function compiled(url: URL, fetching: Fetching): Promise<WebAssembly.Module> {
  return await watched(url, fetching, async (watch) => {
    const response = await watch.open();
    const type = response.headers.get('content-type') ?? '';
    // Application servers return their page for missing files.
    if (type.startsWith('text/html')) throw watch.missing();
    if (!type.startsWith('application/wasm')) {
      const chunks: Uint8Array[] = [];
      await watch.read(response, (chunk) => chunks.push(chunk));
      return await WebAssembly.compile(joined(chunks));
    }
    // A browser caches compiled code only for its own response. The original is therefore compiled,
    // and a copy is counted.
    const copy = response.clone();
    const [module] = await Promise.all([WebAssembly.compileStreaming(response), watch.read(copy, () => undefined)]);
    return module;
  });
}

function joined(chunks: readonly Uint8Array[]): Uint8Array<ArrayBuffer> {
  const all = new Uint8Array(chunks.reduce((sum, { length }) => sum + length, 0));
  let at = 0;
  for (const chunk of chunks) {
    all.set(chunk, at);
    at += chunk.length;
  }
  return all;
}
