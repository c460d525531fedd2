/** Audio output: one audio context for all players of a page on the same device, because browsers allow only a few. */

/** The page's sound, which the user may have to allow. */
export interface Permission {
  /** True if audio is likely allowed to start, as far as can be known immediately. */
  readonly likely: boolean;
  /** Starts the audio; resolves with false if the browser requires a user action first. */
  wake(): Promise<boolean>;
}

/**
 * Maximum output latency, seconds; wireless outputs have some tenths. A browser whose device stumbled may report seconds, for minutes, and captions and lips
 * would be that late.
 */
const MAX_LATENCY_SECS = 1;
/** A browser that allows sound starts it within this, even on a busy machine. */
const REFUSAL_MS = 2000;
/** Timeout for starting audio after a user action. */
const PATIENCE_MS = 20_000;

/** Contexts by device name; the empty name is the user's default device. */
const contexts = new Map<string, SinkAudioContext>();

interface SinkAudioContext extends AudioContext {
  /** Sets the output device; not supported by all browsers. */
  setSinkId?(device: string): Promise<void>;
}

const make = (): SinkAudioContext => new AudioContext({ latencyHint: 'interactive' });

/** Returns the audio context of a device; a new one if the previous was closed. */
export function contextOf(device: string): AudioContext {
  let audio = contexts.get(device);
  if (audio === undefined || audio.state === 'closed') {
    audio = make();
    // It was opened before, by `openDevice`, so a refusal means that it was unplugged: then the usual one plays.
    if (device !== '') void audio.setSinkId?.(device).catch(() => undefined);
    contexts.set(device, audio);
  }
  return audio;
}

/** Prepares a device for playback. Rejects like `HTMLMediaElement.setSinkId`, with `NotSupportedError` if the browser does not support device selection. */
export async function openDevice(device: string): Promise<void> {
  if (device === '' || contexts.has(device)) return;
  const audio = make();
  try {
    if (audio.setSinkId === undefined) throw new DOMException('This browser plays sound on one device only.', 'NotSupportedError');
    await audio.setSinkId(device);
    contexts.set(device, audio);
  } catch (error) {
    void audio.close();
    throw error;
  }
}

/** Returns true if Web Audio is available. */
export function hasAudio(): boolean {
  return typeof AudioContext !== 'undefined';
}

/** Starts a context; resolves with false if the browser requires a user action first. Call it directly from a click or key handler. */
export async function wake(audio: AudioContext): Promise<boolean> {
  if (audio.state === 'running') return true;
  // resume() stays pending until a user activation, so only a timeout detects a refusal.
  const patience = navigator.userActivation?.hasBeenActive ? PATIENCE_MS : REFUSAL_MS;
  await Promise.race([audio.resume().catch(() => undefined), new Promise((done) => setTimeout(done, patience))]);
  return (audio.state as AudioContextState) === 'running';
}

/** Returns the audio permission of a player's output device. */
export function soundOf(player: { readonly sinkId: string }): Permission {
  return {
    get likely() {
      return !hasAudio() || contexts.get(player.sinkId)?.state === 'running' || (navigator.userActivation?.hasBeenActive ?? false);
    },
    async wake() {
      return !hasAudio() || (await wake(contextOf(player.sinkId)));
    },
  };
}

/** Returns the delay from audio rendering to audible output, in seconds. */
export function latency({ outputLatency, baseLatency }: Pick<AudioContext, 'outputLatency' | 'baseLatency'>): number {
  return (outputLatency < MAX_LATENCY_SECS && outputLatency) || baseLatency || 0;
}

/** Returns the audible time of a context, seconds of its own clock. */
export function heardOf(audio: AudioContext): number {
  const coarse = audio.currentTime - latency(audio);
  // The time stamp is finer than currentTime, which moves in steps of the device. Some browsers
  // leave it at zero or far off, and a stuttering device leaves it behind: it is trusted within a
  // third of a step.
  const stamp = audio.getOutputTimestamp();
  if (!stamp.contextTime || !stamp.performanceTime) return coarse;
  const fine = stamp.contextTime + (performance.now() - stamp.performanceTime) / 1000;
  const most = Math.max(0.003, 0.3 * audio.baseLatency);
  return Math.abs(fine - coarse) < 0.06 ? Math.min(coarse + most, Math.max(coarse - most, fine)) : coarse;
}
