/** `<raconteur-composite>`: builds a face from memory on any page. */

import { LitElement, unsafeCSS, type PropertyDeclarations, type PropertyValues, type TemplateResult } from 'lit';
import type { RaconteurPlayer } from '../element/element.js';
import type { Faces } from '../element/face/faces.js';
import { openFaces } from '../element/face/open-faces.js';
import type { Backend, Quality } from '../element/base/types.js';
import base from '../pages/base.css?inline';
import casting from '../pages/cast.css?inline';
import controls from '../pages/controls.css?inline';
import { SIDES } from '../pages/head-view.js';
import { cast } from '../pages/cast.js';
import { Tabs } from '../pages/tabs.js';
import viewerControls from '../pages/viewer/controls.css?inline';
import { onUndoKeys } from '../pages/workbench.js';
import { label } from './acts.js';
import { App, type Tab } from './app.js';
import look from './composite.css?inline';
import { EditorServices } from './editor-services.js';
import { FineDetail } from './fine-detail.js';
import { handle } from './hands.js';
import type { SavedHistory } from './history.js';
import { SessionKeeper, reopen } from './session-keeper.js';
import pictures from './pictures.css?inline';
import { fetchSaved } from './saved.js';
import { readScene } from './scene.js';
import { Session } from './session.js';
import { rest, speaking, views } from './stage.js';
import { reason, type EditorFeedback } from './editor-feedback.js';
import { TABS, template } from './template.js';
import { tools } from './tools.js';

/** Maximum delay until the requested image is shown, milliseconds. */
const SHOWN_MS = 250;
/** Inputs in which keys write. */
const TYPED: readonly string[] = ['number', 'text', 'search'];
const KEYS: Readonly<Record<string, number>> = { f: SIDES.Front, t: SIDES['Three-quarter'], p: SIDES.Left };

const attributes: PropertyDeclarations = { assets: {}, figure: {}, src: {}, label: {}, session: {}, backend: {}, quality: {} };

/** Events of the editor's own; as those of a media element they do not bubble. */
export interface CompositeEventMap {
  /** Fired when the face is shown and can be changed. */
  ready: CustomEvent<undefined>;
  /** Fired when the history has changed: a step was added, undone, visited or named, or another session is open. */
  change: CustomEvent<{
    /** Description of the step whose face is shown. */
    readonly label: string;
    /** Number of steps in the history, on all its branches. */
    readonly steps: number;
  }>;
  /** Fired after an error, with a message for users, which is also displayed. The previous state is kept. */
  error: CustomEvent<{ readonly message: string }>;
}

/**
 * The custom element. Properties follow its attributes; it writes none on itself. `ElementInternals` provide its role and name, which an author's `role` and
 * `aria-label` override.
 */
export class RaconteurComposite extends LitElement {
  /** Default location of the asset library, without the attribute `assets`: set by the script that a page loads. */
  static library = 'assets/';
  static override styles = [base, casting, controls, viewerControls, look, pictures].map((css) => unsafeCSS(css));
  static override properties = attributes;

  /** Address of the asset library, which contains `figures/` and `faces/`; by default `assets/` next to the script. Read when the editor opens. */
  declare assets: string;
  /** Figure that shows the face: a name in the library or the address of a file, like a player's. Follows the user's choice. */
  declare figure: string | undefined;
  /** Address of a saved session to start with, if the browser has stored none; a later value is opened immediately. */
  declare src: string | undefined;
  /** Accessible name of the editor. */
  declare label: string;
  /** Name under which the browser stores the work, separately for each name; without one nothing is stored. Read when the editor opens. */
  declare session: string | undefined;
  /** Forces a back end of the players. Read when the editor opens. */
  declare backend: Backend | undefined;

  /** Rendering quality, like a player's. With `auto`, the default, a stage with simple rendering is rendered in full quality once the face rests. */
  declare quality: Quality;

  // Browsers without it have no role and name for the region, and all else.
  readonly #internals = this.attachInternals?.() as ElementInternals | undefined;
  #player: RaconteurPlayer | undefined;
  #app: App | undefined;
  #desk: EditorServices | undefined;
  #fine: FineDetail | undefined;
  #session: Session | undefined;
  #tabs: Tabs<Tab> | undefined;
  #share: number | undefined;
  #trouble = '';
  #status = '';
  #begun = false;
  /** True once all releasable resources have been released. */
  #released = false;
  #settle: { readonly opened: () => void; readonly failed: (error: unknown) => void } | undefined;
  readonly #ready: Promise<void>;
  readonly #tell: EditorFeedback = {
    say: (status) => {
      this.#status = status;
      this.requestUpdate();
    },
    trouble: (message) => {
      this.#trouble = message;
      this.requestUpdate();
      if (message !== '') this.#fire('error', { message });
    },
  };
  readonly #resized = new ResizeObserver(() => this.#centreSoon());

  constructor() {
    super();
    if (this.#internals !== undefined) this.#internals.role = 'region';
    this.assets = RaconteurComposite.library;
    this.label = 'Composite editor';
    this.quality = 'auto';
    this.#ready = new Promise((opened, failed) => {
      this.#settle = { opened, failed };
    });
    // Pages that do not use the promise receive the event.
    this.#ready.catch(() => undefined);
  }

  // --- for pages ---

  /** Promise that resolves when the face is shown and can be changed; rejects when the editor cannot be opened. */
  get ready(): Promise<void> {
    return this.#ready;
  }

  /** Player that shows the face, once the element has been in a page. */
  get player(): RaconteurPlayer | undefined {
    return this.#player;
  }

  /** The face as numbers, once it is ready. Direct changes are not part of the history. */
  get faces(): Faces | undefined {
    return this.#app?.faces;
  }

  /**
   * Opens a session returned by `save` or read from a file, and resolves when its face is shown; rejects if it cannot be read, and keeps the previous state.
   */
  async open(saved: unknown): Promise<void> {
    await this.#ready;
    this.#session?.settle();
    this.#app?.open(saved);
    // The session that was open before remains stored.
    void this.#session?.begin();
    this.#changed();
    await this.#app?.shownAsItIs;
  }

  /** Returns the session as data, for `JSON.stringify`; undefined until the editor is ready. */
  save(): SavedHistory | undefined {
    // Returns a copy, because the history continues.
    return structuredClone(this.#app?.save());
  }

  /** Undoes the last step, if there is one. */
  undo(): void {
    if (this.#app?.history.canUndo) this.#app.undo();
  }

  /** Redoes the last undone step, if there is one. */
  redo(): void {
    if (this.#app?.history.canRedo) this.#app.redo();
  }

  /** Returns a copy of the face's image, at its rendered size; undefined if there is none. */
  snapshot(): HTMLCanvasElement | undefined {
    return this.#player?.snapshot();
  }

  /** Moves the keyboard focus to the controls. */
  override focus(options?: FocusOptions): void {
    this.#find('#panel')?.focus(options);
  }

  // --- life ---

  override connectedCallback(): void {
    super.connectedCallback();
    if (this.#player === undefined) return;
    this.#resized.observe(this.#player);
    if (!this.#begun) void this.#begin();
    if (this.#released) void this.#session?.resume();
    this.#released = false;
  }

  override disconnectedCallback(): void {
    super.disconnectedCallback();
    this.#resized.disconnect();
    // Moving an element disconnects it for a moment.
    setTimeout(() => {
      if (this.isConnected) return;
      this.#released = true;
      this.#session?.close();
      this.#desk?.release();
      this.#fine?.release();
    });
  }

  protected override firstUpdated(): void {
    const player = (this.#player = this.#find<RaconteurPlayer>('#player'));
    if (player === undefined) return;
    player.assets = this.assets;
    player.backend = this.backend;
    player.quality = this.quality;
    player.figure = this.figure;
    this.#tabs = new Tabs<Tab>(
      (name): name is Tab => name in TABS,
      (tab) => {
        if (this.#app === undefined) return;
        this.#app.turnTo(tab);
        // Each panel is read from its top.
        this.#find('#panel')?.scrollTo(0, 0);
      },
      this.renderRoot,
    );
    this.#listen(player);
    this.#resized.observe(player);
    void this.#begin();
  }

  protected override willUpdate(changed: PropertyValues<this>): void {
    if (changed.has('label') && this.#internals !== undefined) this.#internals.ariaLabel = this.label;
    if (this.#player === undefined) return;
    this.#player.quality = this.quality;
    // The page changed the quality, so the fully detailed rendering is no longer requested, or is
    // requested now.
    if (changed.has('quality')) this.#fine?.changed();
    if (changed.has('figure') && this.figure !== this.#player.figure) this.#player.figure = this.figure;
    if (changed.has('src') && this.src && this.#app !== undefined) void this.#openSource(this.src);
  }

  protected override updated(): void {
    const panel = this.#find('#panel');
    if (panel !== undefined) this.#tabs?.mark(this.#app?.tab ?? 'features', panel);
    this.#reveal();
    // A button that becomes disabled would lose the focus and move it out of the editor and its
    // shortcuts.
    const focused = this.shadowRoot?.activeElement;
    if (focused instanceof HTMLButtonElement && focused.disabled) focused.parentElement?.querySelector<HTMLElement>('button:enabled')?.focus();
  }

  protected override render(): TemplateResult {
    const state = { placing: this.#app?.placing !== undefined, share: this.#share, trouble: this.#trouble, status: this.#status };
    const [app, desk, player] = [this.#app, this.#desk, this.#player];
    if (app === undefined || desk === undefined || player === undefined) return template(state);
    return template({
      ...state,
      tools: tools(app, this, this.#tell),
      views: views(app),
      panel: desk.draw(app.tab),
      speaking: speaking(player, this.#tell),
    });
  }

  // --- methods ---

  async #begin(): Promise<void> {
    this.#begun = true;
    this.#share = 0;
    this.requestUpdate();
    try {
      await this.#open();
      this.#settle?.opened();
      this.#fire('ready', undefined);
    } catch (error) {
      // It begins again when the element is reconnected.
      this.#begun = this.isConnected;
      if (!this.#begun) return;
      this.#settle?.failed(error);
      this.#tell.trouble(`The editor could not be opened: ${reason(error)}`);
    } finally {
      this.#share = undefined;
      this.requestUpdate();
    }
  }

  async #open(): Promise<void> {
    const player = this.#player;
    const place = this.#find('#portraits');
    const pad = this.#find('#pad');
    const over = this.#find<HTMLCanvasElement>('#fine');
    if (player === undefined || place === undefined || pad === undefined || over === undefined) throw new Error('it has no stage');
    this.#session?.close();
    this.#session = this.session ? new Session(this.session, this.#tell.trouble) : undefined;
    const pack = (file: string): URL => new URL(`${player.assets.replace(/\/?$/, '/')}faces/${file}`, document.baseURI);
    const progress = (share: number): void => {
      this.#share = share;
      this.requestUpdate();
    };
    const kept = await this.#session?.open();
    const { figure } = readScene(kept?.saved);
    // The player that showed the face shows it again without waiting for another event.
    if (figure !== undefined) player.figure = this.figure = figure;
    const [faces] = await Promise.all([openFaces(pack('people.faces'), pack('people.skins'), { progress }), rest(player)]);
    const app = new App(player, faces, {
      draw: () => this.requestUpdate(),
      say: (message) => {
        this.#tell.trouble(message);
        this.#tell.say(message);
      },
      changed: () => this.#changed(),
      shown: () => this.#desk?.shown(),
      moved: () => {
        this.#fine?.changed();
        if (this.#app !== undefined) this.#session?.keepSoon(() => app.save());
      },
      cast: (name) => {
        this.figure = name;
      },
    });
    const keeping = this.#session && new SessionKeeper(app, this.#session, this.#tell, () => this.#told());
    if (kept !== undefined) keeping?.goOn(kept);
    else if (this.src) reopen(app, await fetchSaved(this.src).catch((error: unknown) => this.#tell.trouble(reason(error))), this.#tell);
    handle(app, pad);
    this.#fine = new FineDetail(app, place, over, () => this.#desk?.busy === true);
    this.#desk = new EditorServices(app, place, this.#tell, keeping);
    await app.show();
    this.#app = app;
    app.view.look({});
    this.#centreSoon();
    this.requestUpdate();
    await this.updateComplete;
  }

  async #openSource(src: string): Promise<void> {
    try {
      await this.open(await fetchSaved(src));
    } catch (error) {
      this.#tell.trouble(reason(error));
    }
  }

  #changed(): void {
    const app = this.#app;
    if (app === undefined) return;
    this.#session?.keep(app.save());
    this.#told();
  }

  /** Notifies the page of the history's state. */
  #told(): void {
    const app = this.#app;
    if (app === undefined) return;
    this.#tell.trouble('');
    const { steps, here } = app.history;
    const step = steps[here];
    this.#fire('change', { label: step === undefined ? '' : (step.name ?? label(step.act)), steps: steps.length - 1 });
  }

  #centreSoon(): void {
    this.#fine?.changed();
    setTimeout(() => this.#app?.view.centre(), SHOWN_MS);
  }

  /** Listens on the shadow root, so only events in this editor arrive. */
  #listen(player: RaconteurPlayer): void {
    const root = this.renderRoot;
    cast(
      player,
      () => {
        this.figure = player.figure;
      },
      root,
    );
    // In a text field, undo applies to letters.
    const types = ({ target }: Event): boolean => target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && TYPED.includes(target.type));
    onUndoKeys(
      () => this.undo(),
      () => this.redo(),
      types,
      root,
    );
    root.addEventListener('keydown', (event) => {
      if (!(event instanceof KeyboardEvent) || event.ctrlKey || event.metaKey || event.altKey) return;
      if (event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement || event.target instanceof HTMLTextAreaElement) return;
      const turn = KEYS[event.key];
      if (turn !== undefined) this.#app?.view.look({ turn, tilt: 0.02 });
    });
    for (const type of ['play', 'pause', 'ended', 'seeked'] as const) {
      player.addEventListener(type, () => {
        this.#fine?.changed();
        this.#app?.redraw();
      });
    }
    // The sentence has ended, so the face returns to rest.
    player.addEventListener('ended', () => void rest(player));
    // A figure of another height has its head at another position, and comes with its own face.
    player.addEventListener('figurechange', () => this.#dress());
    // The same holds for the stage of an editor that returns to a page.
    player.addEventListener('loadedmetadata', () => {
      if (this.#app !== undefined) void rest(player).then(() => this.#dress());
    });
  }

  /** Scrolls the requested section of the panel into view, and focuses it. */
  #reveal(): void {
    const sought = this.#app?.sought;
    if (this.#app === undefined || sought === undefined) return;
    this.#app.sought = undefined;
    const section = this.#find(`#panel section[aria-label="${CSS.escape(sought)}"]`);
    section?.scrollIntoView({ block: 'nearest' });
    section?.querySelector<HTMLElement>('select, button, input')?.focus({ preventScroll: true });
  }

  /** Puts the face on a new figure on stage. */
  #dress(): void {
    this.#centreSoon();
    void this.#app?.show();
    this.#app?.redraw();
  }

  #find<E extends HTMLElement>(selector: string): E | undefined {
    return this.renderRoot.querySelector<E>(selector) ?? undefined;
  }

  #fire<K extends keyof CompositeEventMap>(type: K, detail: CompositeEventMap[K]['detail']): void {
    this.dispatchEvent(new CustomEvent(type, { detail }));
  }
}

declare global {
  interface HTMLElementTagNameMap {
    'raconteur-composite': RaconteurComposite;
  }
}
