/** State of the page: settings of each player, and synchronised playback of both. */

import type { RaconteurPlayer } from '../../element/element.js';
import { PageState } from '../page-state.js';
import { ComparisonSide } from './comparison-side.js';
import { beginning, settingOf, type Setting, type Side, type State } from './state.js';
import { write } from './write.js';

/** Diagnostic of every text without a voice, ignored here because this page needs none. */
const NO_VOICE = 'player::no-bundle';

/** Players that are further apart than this do not play as one. */
const APART_SECS = 0.2;

export type Tab = 'types' | 'disc';

export class App extends PageState<State> {
  tab: Tab = 'types';
  readonly sittings: Readonly<Record<Side, ComparisonSide>>;

  constructor(
    a: RaconteurPlayer,
    b: RaconteurPlayer,
    private readonly render: () => void,
  ) {
    super(a, beginning, (state) => write(state.a));
    this.sittings = { a: new ComparisonSide(a, () => this.#tell()), b: new ComparisonSide(b, () => this.#tell()) };
    this.#playTogether();
  }

  /** Sides on stage. */
  get shown(): readonly Side[] {
    return this.state.compares ? ['a', 'b'] : ['a'];
  }

  /** Setting that the controls change. */
  get edited(): Setting {
    return settingOf(this.state, this.state.edits);
  }

  /** Returns a change of the state that applies `change` to the edited setting. */
  edit(change: (setting: Setting) => void): (state: State) => void {
    return (state) => {
      const setting = settingOf(state, state.edits);
      change(setting);
      state[state.edits] = setting;
    };
  }

  compare(on: boolean): void {
    this.set((s) => {
      s.compares = on;
      s.b = settingOf(s, 'b');
      s.edits = on ? 'b' : 'a';
    });
  }

  /** Plays from the beginning, before the emotion starts. */
  playAll(): void {
    this.player.currentTime = 0;
    this.player.play().catch(() => undefined);
  }

  /** Plays both together with one in the lead: two voices would be indistinguishable, so only the player whose setting is edited has speech and music. */
  #playTogether(): void {
    const { a, b } = this.sittings;
    let isNew = false;
    const join = (): void => {
      if (!this.state.compares || a.player.paused) return;
      if (Math.abs(a.player.currentTime - b.player.currentTime) > APART_SECS) b.player.currentTime = a.player.currentTime;
      if (b.player.paused) b.player.play().catch(() => undefined);
    };
    a.player.addEventListener('playing', () => {
      isNew = true;
      join();
    });
    b.player.addEventListener('loadedmetadata', join);
    // A player that waited for a voice has fallen behind; it seeks once, because each seek may take
    // as long again.
    b.player.addEventListener('playing', () => {
      if (isNew) join();
      isNew = false;
    });
    a.player.addEventListener('pause', () => b.player.pause());
    a.player.addEventListener('ratechange', () => (b.player.playbackRate = a.player.playbackRate));
    a.player.addEventListener('ended', () => Object.values(this.sittings).forEach((sitting) => sitting.stand()));
    a.player.addEventListener('figurechange', () => {
      if (a.player.figure !== undefined) b.player.figure = a.player.figure;
    });
  }

  protected override draw(): void {
    this.render();
  }

  protected override follow(): string {
    return write(this.edited);
  }

  /** Loads the text of each player on stage. */
  override rehearse(): Promise<void> {
    const { a, b } = this.sittings;
    const { edits, compares } = this.state;
    a.player.muted = edits !== 'a';
    b.player.muted = edits !== 'b';
    b.player.hidden = !compares;
    if (!compares) b.player.pause();
    for (const side of this.shown) this.sittings[side].take(write(settingOf(this.state, side)));
    return Promise.resolve();
  }

  /** Handles a player's change of text or time. */
  #tell(): void {
    this.diagnostics = this.sittings[this.state.edits].player.diagnostics.filter(({ code }) => code !== NO_VOICE);
    this.redraw();
  }
}
