/** The page's state: the text, its clauses, the selection, and the stage. */

import type { RaconteurPlayer } from '../../element/element.js';
import type { Diagnostic } from '../../element/base/types.js';
import { readPose, type PoseNow } from '../../element/engine/pose.js';
import { Editor } from './editor.js';
import { setValue } from './edit.js';
import { FEATURES, gestureOf, joined, toldApart, trackOf, type Feature, type Gesture, type Hand, type Key, type Phase, type Track, type Value } from './gesture.js';
import { remember } from './memory.js';
import type { Palms } from './palm.js';
import { delayOf } from '../run-up.js';
import { read, type Change } from '../source.js';

export type Tab = 'phase' | Feature | 'course';

export class App {
  readonly editor: Editor;
  gesture: Gesture;
  diagnostics: readonly Diagnostic[] = [];
  tab: Tab = 'shape';
  /** Indices of the selection. */
  #phase = 0;
  #hand: Hand = 'right';
  readonly #key: Record<Feature, number> = { shape: 0, palm: 0, place: 0 };
  /** The feature whose course is edited. */
  courseOf: Feature = 'place';
  /** True if the course applies to the whole track, not to one key. */
  wholeTrack = false;
  /** True if the second of two mixed shapes is being chosen. */
  second = false;
  pose: PoseNow | undefined;
  /** The engine's reading of palms, once it is there. */
  palms: Palms | undefined;
  #drawing = 0;
  #rehearsing = false;
  #rehearsed: string | undefined;

  constructor(
    readonly player: RaconteurPlayer,
    host: HTMLElement,
    text: string,
    readonly draw: () => void,
  ) {
    this.gesture = gestureOf(read(text));
    this.editor = new Editor(host, 'EML of the gesture', text, {
      text: (now) => this.#changed(now),
      moved: () => this.redraw(),
    });
    for (const type of ['timeupdate', 'play', 'pause', 'ended', 'seeked', 'loadedmetadata', 'figurechange', 'error']) {
      player.addEventListener(type, () => this.redraw());
    }
    player.addEventListener('figurechange', () => void this.rehearse());
    new ResizeObserver(() => this.redraw()).observe(player);
  }

  // --- selection ---

  get phase(): Phase | undefined {
    return this.gesture.phases[this.#phase] ?? this.gesture.phases.at(-1);
  }

  get phaseIndex(): number {
    return Math.min(this.#phase, this.gesture.phases.length - 1);
  }

  /** Hand whose tracks are shown. */
  get hand(): Hand {
    const { phase } = this;
    if (phase === undefined) return this.#hand;
    if (phase.hands !== 'both') return phase.hands;
    return toldApart(phase) ? this.#hand : 'right';
  }

  set hand(hand: Hand) {
    this.#hand = hand;
    this.redraw();
  }

  track(feature: Feature): Track | undefined {
    return this.phase && trackOf(this.phase, feature, this.hand);
  }

  key(feature: Feature): Key | undefined {
    const keys = this.track(feature)?.keys;
    return keys?.[Math.min(this.#key[feature], keys.length - 1)];
  }

  keyIndex(feature: Feature): number {
    return Math.min(this.#key[feature], (this.track(feature)?.keys.length ?? 1) - 1);
  }

  selectPhase(index: number): void {
    if (index === this.phaseIndex) {
      this.redraw();
      return;
    }
    this.#phase = index;
    for (const feature of FEATURES) this.#key[feature] = 0;
    this.#showKey();
  }

  selectKey(phase: number, feature: Feature, key: number): void {
    if (phase !== this.phaseIndex) for (const f of FEATURES) this.#key[f] = 0;
    this.#phase = phase;
    this.#key[feature] = key;
    if (this.tab === 'course') this.courseOf = feature;
    else this.tab = feature;
    this.#showKey(feature);
  }

  selectTab(tab: Tab): void {
    if (FEATURES.includes(tab as Feature)) this.courseOf = tab as Feature;
    // A first key is where a phase begins; there is a course to the second.
    if (tab === 'course') this.#key[this.courseOf] ||= 1;
    this.tab = tab;
    if (tab === 'phase') this.redraw();
    else this.#showKey();
  }

  /** Shows the frame of the edited key, except during playback. */
  #showKey(feature: Feature = this.tab === 'phase' ? 'place' : this.tab === 'course' ? this.courseOf : this.tab): void {
    const { phase } = this;
    const secs = this.key(feature)?.secs ?? (phase === undefined ? 0 : phase.durationSecs);
    if (this.player.paused && phase?.startSecs !== undefined) this.seek(phase.startSecs + secs);
    if (phase !== undefined) this.editor.reveal((this.key(feature)?.element ?? phase.element).from);
    this.redraw();
  }

  // --- time ---

  /** Delay of the player relative to the text's times. */
  get delaySecs(): number {
    const starts = this.gesture.phases.map((phase) => phase.startSecs);
    return starts.length === 0 || starts.includes(undefined) ? 0 : delayOf(Math.min(...starts.map((s) => s ?? 0)));
  }

  /** Time on stage, in the time of the text. */
  get secs(): number {
    return this.player.currentTime - this.delaySecs;
  }

  seek(secs: number): void {
    this.player.currentTime = secs + this.delaySecs;
  }

  /** End of the last phase, in the time of the text. */
  get endSecs(): number {
    return Math.max(0, ...this.gesture.phases.map((phase) => (phase.startSecs ?? 0) + phase.durationSecs));
  }

  // --- changes ---

  /** Changes the text in one step. */
  change(changes: readonly Change[]): void {
    this.editor.change(changes);
  }

  /** Changes it for a control that still moves. */
  drag(changes: readonly Change[]): void {
    this.editor.drag(changes);
  }

  /** Sets the value of the selected key of a feature, or of another key of its track, while a control moves. */
  setValue(feature: Feature, value: Value, index = this.keyIndex(feature)): void {
    const key = this.track(feature)?.keys[index];
    const { gesture, phase } = this;
    if (key !== undefined && phase !== undefined) this.drag(setValue(gesture, joined(gesture, phase, feature, this.hand, key), value));
  }

  done(): void {
    this.editor.settle();
  }

  #changed(text: string): void {
    this.gesture = gestureOf(read(text));
    remember(text);
    void this.rehearse();
    this.redraw();
  }

  /** Loads the text on stage; while one is being read, only the latest is queued. */
  async rehearse(): Promise<void> {
    if (this.#rehearsing) return;
    this.#rehearsing = true;
    try {
      while (this.#rehearsed !== this.editor.text) {
        // One for each frame is enough.
        await new Promise(requestAnimationFrame);
        const text = this.editor.text;
        this.diagnostics = await this.player.rehearse(text);
        this.#rehearsed = text;
        // Positions refer to the text that was loaded; if it changed, the next one loads later.
        if (text === this.editor.text) this.editor.show(this.diagnostics);
      }
    } catch {
      // The player itself shows the problem; "Try again" starts again with the text.
      this.#rehearsed = undefined;
    } finally {
      this.#rehearsing = false;
      this.redraw();
    }
  }

  /** Redraws the page once before the next frame. */
  redraw(): void {
    if (this.#drawing !== 0) return;
    this.#drawing = requestAnimationFrame(() => {
      this.#drawing = 0;
      this.pose = readPose(this.player);
      this.draw();
      if (!this.player.paused) this.redraw();
    });
  }
}
