/** State of the face page: its settings, and the view of the head. */

import type { RaconteurPlayer } from '../../element/element.js';
import { HeadView, SIDES } from '../head-view.js';
import { PageState } from '../page-state.js';
import { beginning, type State } from './state.js';
import { write } from './write.js';

export type Tab = 'emotion' | 'muscles' | 'direct' | 'visemes' | 'manner';

/** Zoom at which the head fills the image. */
const NEAR = 7;

export class App extends PageState<State> {
  tab: Tab = 'emotion';
  /** Slow fetch or read in progress; empty for none. */
  busy = '';
  #begins = false;
  readonly view: HeadView;

  constructor(
    player: RaconteurPlayer,
    private readonly render: () => void,
    private readonly reread: () => void,
  ) {
    super(player, beginning, write);
    this.view = new HeadView(player, { turn: SIDES['Three-quarter'], tilt: 0.02, zoom: NEAR }, () => this.redraw());
  }

  /** Speaks from the beginning, once the text is read. */
  fromStart(): void {
    this.#begins = true;
  }

  protected override draw(): void {
    this.render();
  }

  protected override follow(): string {
    const { story } = this.state;
    if ((this.player.getAttribute('src') ?? '') !== story) this.player.src = story === '' ? undefined : story;
    return write(this.state);
  }

  /** False for speech, which is shown at its audible time. */
  protected override get showsEnd(): boolean {
    return this.state.speech.kind === 'none';
  }

  protected override read(): void {
    if (this.#begins) {
      this.#begins = false;
      this.player.currentTime = 0;
      this.player.play().catch(() => undefined);
    }
    this.reread();
  }
}
