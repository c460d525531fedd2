/** Recorder of the samples sent to the speakers, with the times of the audio clock. */

import type { Page } from '@playwright/test';

/** Sound that left Web Audio. */
export interface Captured {
  readonly sampleRate: number;
  /** Start of `samples` on the audio clock, in samples. */
  readonly first: number;
  /** A page that was busy for long has missed some: those are not numbers. */
  readonly samples: Float32Array;
}

declare global {
  interface Window {
    /** Recorded audio, in blocks by their first sample on the audio clock. */
    tap: { context: AudioContext | undefined; ready: boolean; blocks: { from: number; samples: Float32Array }[] };
    /** Samples as text: single precision, base64. */
    coded(samples: Float32Array): string;
  }
}

/** Runs before the page's own scripts: also records all audio sent to the speakers. */
function listen(): void {
  const tap: Window['tap'] = { context: undefined, ready: false, blocks: [] };
  window.tap = tap;
  let hub: ChannelMergerNode | undefined;
  const connect = AudioNode.prototype.connect as (this: AudioNode, ...args: unknown[]) => AudioNode;
  const open = (context: AudioContext): ChannelMergerNode => {
    // A worklet would be a file that the page's policy allows but the test cannot serve. The older
    // node gets only an approximate time, so the second channel counts samples. Single precision
    // counts to 16 million: five minutes.
    const count = context.createBuffer(1, context.sampleRate * 300, context.sampleRate);
    count.getChannelData(0).forEach((_, i, all) => (all[i] = (i + 1) / 2 ** 24));
    const counter = context.createBufferSource();
    counter.buffer = count;
    const start = Math.ceil(context.currentTime * 10 + 1) / 10;
    const merger = context.createChannelMerger(2);
    const node = context.createScriptProcessor(16_384, 2, 1);
    node.onaudioprocess = ({ inputBuffer }) => {
      const counted = inputBuffer.getChannelData(1);
      const heard = inputBuffer.getChannelData(0);
      const index = (i: number) => Math.round((counted[i] ?? 0) * 2 ** 24) - 1;
      // A page that was busy for long reads a block while it is overwritten: samples without
      // consecutive counts are not one block.
      for (let at = 0, end = 0; at < counted.length; at = end) {
        end = at + 1;
        if (index(at) < 0) continue;
        while (end < counted.length && index(end) === index(end - 1) + 1) end += 1;
        tap.blocks.push({ from: Math.round(start * context.sampleRate) + index(at), samples: heard.slice(at, end) });
      }
      tap.blocks.sort((a, b) => a.from - b.from);
      tap.ready = tap.blocks.length > 0;
    };
    connect.call(counter, merger, 0, 1);
    connect.call(merger, node);
    // A node without a connected output need not run; this one outputs silence.
    connect.call(node, context.destination);
    counter.start(start);
    return merger;
  };
  AudioNode.prototype.connect = function (this: AudioNode, to: AudioNode, ...rest: []) {
    if (to instanceof AudioDestinationNode && to.context instanceof AudioContext) {
      tap.context = to.context;
      hub ??= open(to.context);
      connect.call(this, hub, 0, 0);
    }
    return connect.call(this, to, ...rest);
  } as typeof AudioNode.prototype.connect;
}

/** Installs the recorder in the next opened page. */
export async function tapInto(page: Page): Promise<void> {
  await page.addInitScript(listen);
  await page.addInitScript(() => {
    window.coded = (samples) => {
      // Samples are not rounded, because the last bit may decide the periods that a slower voice
      // repeats.
      const bytes = new Uint8Array(samples.slice().buffer);
      let text = '';
      for (let i = 0; i < bytes.length; i += 30_000) text += btoa(String.fromCharCode(...bytes.subarray(i, i + 30_000)));
      return text;
    };
  });
}

/** Returns all audio recorded up to now. */
export async function captured(page: Page): Promise<Captured> {
  const { sampleRate, first, text, blocks } = await page.evaluate(() => {
    const { blocks, context } = window.tap;
    const first = blocks[0]?.from ?? 0;
    const last = blocks.at(-1);
    const all = new Float32Array(last === undefined ? 0 : last.from + last.samples.length - first);
    for (const { from, samples } of blocks) all.set(samples, from - first);
    return { sampleRate: context?.sampleRate ?? 0, first, text: window.coded(all), blocks: blocks.map((b) => [b.from, b.from + b.samples.length] as const) };
  });
  const samples = decoded(text);
  blocks.forEach(([, end], i) => samples.fill(NaN, end - first, (blocks[i + 1]?.[0] ?? end) - first));
  return { sampleRate, first, samples };
}

/** Returns the samples that `coded` encoded. */
export function decoded(text: string): Float32Array {
  const bytes = Buffer.from(text, 'base64');
  return Float32Array.from({ length: bytes.length / 4 }, (_, i) => bytes.readFloatLE(4 * i));
}

/**
 * Freezes the audio clock of the next opened page within a task, so all code in one task, and its continuations before the next, reads the same time: a
 * caption and the time for which it was chosen can be compared, however busy the machine is.
 */
export async function steadyClock(page: Page): Promise<void> {
  await page.addInitScript(() => {
    const known = new Map<string, number>();
    const { port1, port2 } = new MessageChannel();
    // A message is a task of its own.
    port1.onmessage = () => known.clear();
    for (const [prototype, name] of [
      [BaseAudioContext.prototype, 'currentTime'],
      [AudioContext.prototype, 'outputLatency'],
    ] as const) {
      const own = (Object.getOwnPropertyDescriptor(prototype, name) ?? Object.getOwnPropertyDescriptor(Object.getPrototypeOf(prototype), name))?.get;
      Object.defineProperty(prototype, name, {
        configurable: true,
        get(this: AudioContext) {
          let value = known.get(name);
          if (value === undefined) {
            if (known.size === 0) port2.postMessage(null);
            known.set(name, (value = own?.call(this) as number));
          }
          return value;
        },
      });
    }
    // Finer than the clock, and never twice the same.
    AudioContext.prototype.getOutputTimestamp = () => ({ contextTime: 0, performanceTime: 0 });
  });
}
