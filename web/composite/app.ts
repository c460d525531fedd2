/** State of the composite editor: the history of a face, the selection, and the face on stage. */

import type { RaconteurPlayer } from '../element/element.js';
import type { FaceConstraint, FacePart, FaceRegion, Faces } from '../element/face/faces.js';
import type { FaceLook, FaceMark, FigureFace } from '../element/base/face-types.js';
import type { Light } from '../element/base/types.js';
import { HeadView, SIDES } from '../pages/head-view.js';
import { AGEING, changedBy, perform, type Act } from './acts.js';
import { Cache } from './cache.js';
import { History, type SavedHistory } from './history.js';
import { LIMITS } from './limits.js';
import { lookOf, type Person } from './people.js';
import { isLibraryName, readScene, type Scene } from './scene.js';
import { FaceView } from './face-view.js';
import { skinOf } from './skin.js';
import { AttributeReading, AttributeSlopes, type Values } from './values.js';
import { yearsOf } from './words.js';

export type Tab = 'start' | 'features' | 'parts' | 'look' | 'marks' | 'held' | 'history' | 'pictures';

/** Zoom at which the head fills the image. */
const NEAR = 7.4;

/** Age lines of an average face, and their increase per unit of the ageing value, of 1. */
const LINES = 0.1;
const LINES_PER_AGE = 0.7;
/** Interval of stored faces among steps that are recomputed in sequence. */
const CHECKPOINT = 16;
/** Skin that is not chosen is so bright. */
const UNLIT = 0.55;

/** Functions of the page apart from the face. */
interface Page {
  draw(): void;
  /** Reports a failure or a success. */
  say(text: string): void;
  /** Called when the history has changed. */
  changed(): void;
  /** Called when the stage shows the face. */
  shown(): void;
  /** Reports that the stage should show something else. */
  moved(): void;
  /** Requests another figure of the library to show the face. */
  cast(figure: string): void;
}

export class App {
  /** A face is best begun with one of the database. */
  tab: Tab = 'start';
  /** Displayed group of attributes. */
  group = 'overall';
  /** Converts a value of the age attribute to an age. */
  readonly yearsOf: (value: number) => number;
  /** Search text, as typed. */
  search = '';
  /** Section of the panel to scroll into view on the next rendering. */
  sought: string | undefined;
  /** True to change correlated features together with a feature. */
  withAll = false;
  /** Features have sliders for their left and right apart. */
  apart = false;
  /** Part to take over from a face of the database. */
  taken: FacePart | 'both' = 'both';
  /** Selected segments to change; the whole head if empty. */
  readonly segments = new Set<string>();
  half: 'left' | 'right' | undefined;
  /** True to highlight the selection on the face. */
  lit = true;
  /** Object that the next press places on the skin: a new mark, or an existing one to move. */
  placing: FaceMark['kind'] | number | undefined;
  light: { readonly name: Light; readonly turn: number } = { name: 'stage', turn: 0 };
  /** Effect of dragging on the image. */
  drag: 'view' | 'move' | 'turn' | 'scale' = 'view';
  /** The slider of moves that is being dragged. */
  sliding: { readonly name: string; readonly amount: number } | undefined;
  /** Filter for the faces of the database. */
  readonly person: Person = { sex: 'any', age: 'any', ancestry: 'any' };
  /** Index of the first displayed face of the database, among the filtered ones. */
  first = 0;
  history = new History();
  readonly view: HeadView;
  readonly #kept = new Cache();
  readonly #reading: AttributeReading;
  readonly #showing: FaceView;
  /** The step that a control which moves begins at, and its act by now. */
  #moving: { readonly from: Uint8Array; readonly values: Values; readonly slopes: AttributeSlopes; act: Act | undefined } | undefined;
  #drawn = 0;

  constructor(
    readonly player: RaconteurPlayer,
    readonly faces: Faces,
    private readonly page: Page,
  ) {
    this.yearsOf = yearsOf(faces.pack.people);
    this.#reading = new AttributeReading(faces);
    this.#showing = new FaceView(
      player,
      () => this.shown,
      (error) => {
        if (error !== undefined) this.page.say(error instanceof Error ? error.message : String(error));
        this.page.shown();
      },
    );
    this.view = new HeadView(player, { turn: SIDES.Front, tilt: 0.02, zoom: NEAR }, () => {
      this.page.moved();
      this.redraw();
    });
  }

  /** True if the stage shows the face of the present step and no control is moving. */
  get resting(): boolean {
    return this.#moving === undefined && !this.#showing.busy;
  }

  /** Scope of a feature's change: the selected segments, or the whole head; isolated, unless correlated features change too. */
  get manner(): { readonly region: FaceRegion; readonly withAll: boolean; readonly alone: boolean } {
    const { region, withAll } = this;
    return { region, withAll, alone: !withAll };
  }

  get region(): FaceRegion {
    return { segments: [...this.segments], half: this.half };
  }

  get held(): readonly FaceConstraint[] {
    return this.history.heldAt(this.history.here);
  }

  /** Hair and accessories of the head, including an active control's change. */
  get look(): FaceLook {
    const act = this.#moving?.act;
    if (act?.kind === 'look') return act.look;
    const { history } = this;
    const random = history.randomAt(history.here);
    const index = random === undefined ? history.exampleAt(history.here) : this.faces.randomPerson(random);
    const person = this.faces.pack.people[index ?? -1];
    return history.lookAt(history.here) ?? (person === undefined ? {} : lookOf(person, this.player.naturalHair()));
  }

  /** Marks on the skin, including an active control's change. */
  get marks(): readonly FaceMark[] {
    const act = this.#moving?.act;
    return act?.kind === 'marks' ? act.marks : this.history.marksAt(this.history.here);
  }

  /** The displayed face. */
  get face(): FigureFace {
    const { look, marks } = this;
    return {
      ...this.faces.face(this.player.currentFigure ?? '', this.#showing.moves),
      look: {
        ...look,
        ...(this.faces.pack.attributes.some((a) => a.part === 'texture') && skinOf(this.values.texture, this.history.seedAt(this.history.here))),
        lines: this.#lines(),
      },
      marks,
    };
  }

  /** Returns the visibility of age lines at rest. */
  #lines(): number {
    const { texture } = this.values;
    const ageing = Math.max(texture.get(AGEING) ?? 0, texture.get('age') ?? 0);
    return Math.min(1, Math.max(0, LINES + ageing * LINES_PER_AGE));
  }

  /** The face with the selection highlighted, while no part of it moves. */
  get shown(): FigureFace {
    const { face } = this;
    if (!this.lit || this.tab !== 'parts' || this.segments.size === 0 || this.#moving !== undefined || !this.player.paused) return face;
    const mask = this.faces.mask([...this.segments]);
    const factors = face.factors?.slice() ?? new Float64Array(3 * mask.length + 6).fill(1);
    const isOther = (v: number): boolean => this.half !== undefined && (face.skin[3 * v] ?? 0) > 0 !== (this.half === 'left');
    mask.forEach((isIn, v) => {
      if (isIn > 0 && !isOther(v)) return;
      for (let i = 3 * v; i < 3 * v + 3; i += 1) factors[i] = (factors[i] ?? 1) * UNLIT;
    });
    return { ...face, factors };
  }

  /** Values of the displayed face. */
  get values(): Values {
    return this.#reading.all;
  }

  /** Values before the current movement of a control. */
  get settled(): Values {
    return this.#moving?.values ?? this.values;
  }

  /** Previews a moving control: restores the face from before the movement, and applies the action. Adds no step yet. */
  move(act: Act): void {
    this.#moving ??= { from: this.faces.keep(), values: this.values, slopes: new AttributeSlopes(this.values), act: undefined };
    const { from, slopes } = this.#moving;
    this.faces.restore(from);
    this.#reading.changed(changedBy(act, this.held));
    if (this.#try(act, from)) {
      this.#moving.act = act;
      if (this.held.length === 0) slopes.setFrom(this.#reading, act);
    } else if (this.#moving.act !== undefined) perform(this.faces, this.#moving.act, this.held);
    this.#showing.moves = true;
    this.#changed([]);
  }

  /** Adds the result of a released control as a step. */
  done(): void {
    const act = this.#moving?.act;
    this.#moving = undefined;
    if (act === undefined) return;
    this.#step(act);
  }

  /** Performs an action immediately. Returns false if it is impossible. */
  do(act: Act): boolean {
    this.done();
    if (!this.#try(act, this.faces.keep())) return false;
    this.#showing.moves = false;
    this.#step(act);
    return true;
  }

  /** Performs an action, or restores the face and reports the reason. */
  #try(act: Act, from: Uint8Array): boolean {
    try {
      perform(this.faces, act, this.held);
      return true;
    } catch (error) {
      this.faces.restore(from);
      this.page.say(error instanceof Error ? error.message : String(error));
      return false;
    }
  }

  #step(act: Act): void {
    this.#kept.keep(this.history.add(act), this.faces.keep());
    this.page.changed();
    this.#changed(changedBy(act, this.held));
  }

  undo(): void {
    this.#go(() => this.history.undo());
  }

  redo(): void {
    this.#go(() => this.history.redo());
  }

  goTo(step: number): void {
    this.#go(() => this.history.go(step));
  }

  #go(way: () => void): void {
    this.done();
    const { here } = this.history;
    const from = this.faces.keep();
    try {
      way();
      this.#arrive();
      this.page.changed();
    } catch (error) {
      // A step of a file need not be one that this model can do.
      this.history.go(here);
      this.faces.restore(from);
      this.page.say(error instanceof Error ? error.message : String(error));
      this.#changed();
    }
  }

  /** Recomputes the face of the current step from the nearest stored one before it. */
  #arrive(): void {
    const path = this.history.path();
    let from = path.length - 1;
    while (from > 0 && this.#kept.get(path[from] ?? 0) === undefined) from -= 1;
    const known = this.#kept.get(path[from] ?? 0);
    if (known === undefined) this.faces.average();
    else this.faces.restore(known);
    const last = path.length - 1;
    let held = this.history.heldAt(path[from] ?? 0);
    for (let i = from + 1; i <= last; i += 1) {
      const step = path[i] ?? 0;
      const { act } = this.history.steps[step] ?? { act: { kind: 'average' } };
      perform(this.faces, act, held);
      if (act.kind === 'hold') held = act.held;
      // Steps that each are within their limits grow beyond all bounds together.
      if (act.kind === 'transform' || act.kind === 'caricature') this.#measure();
      // Undo starts at the latest of these checkpoints, because storing all faces takes longer than
      // computing a few again.
      if (i === last || i % CHECKPOINT === 0) this.#kept.keep(step, this.faces.keep());
    }
    this.#showing.moves = false;
    this.#changed();
  }

  /** Throws where the face is larger than anybody's. */
  #measure(): void {
    if (!this.faces.skin().every((x) => Math.abs(x) < LIMITS.reach)) throw new Error(`The face of this session is larger than ${LIMITS.reach} m.`);
  }

  /** Opens a history that was saved; the one before stays where it cannot be read or made again. */
  open(saved: unknown): void {
    const before = this.history;
    const kept = this.faces.keep();
    try {
      this.history = History.read(saved, this.size);
      this.#kept.clear();
      this.#arrive();
      this.#measure();
    } catch (error) {
      this.history = before;
      this.#kept.clear();
      this.#kept.keep(before.here, kept);
      this.faces.restore(kept);
      throw error;
    }
    this.#setScene(readScene(saved));
  }

  /** Display settings of the face. */
  get scene(): Scene {
    const { figure } = this.player;
    return { ...(isLibraryName(figure) ? { figure } : {}), light: this.light, view: this.view.from };
  }

  #setScene({ figure, light, view }: Scene): void {
    if (figure !== undefined && figure !== this.player.figure) this.page.cast(figure);
    if (light !== undefined) this.relight(light);
    if (view !== undefined) this.view.look(view);
  }

  /** Names the displayed face. */
  name(name: string): void {
    this.history.name(name);
    this.page.changed();
    this.redraw();
  }

  save(): SavedHistory {
    return { ...this.history.save(this.size), scene: this.scene };
  }

  /** Pack data stored in a session. */
  get size(): SavedHistory['pack'] {
    const { faces, vertices } = this.faces.pack;
    return { faces, vertices };
  }

  /** Shows another panel, and a section of it by its title. */
  turnTo(tab: Tab, section?: string): void {
    // The chosen segments are highlighted only next to their own panel.
    const isLit = this.segments.size > 0 && (tab === 'parts') !== (this.tab === 'parts');
    this.tab = tab;
    this.sought = section;
    this.placing = undefined;
    if (isLit) this.chosen();
    else this.redraw();
  }

  /** Lights the face from elsewhere. */
  relight(light: App['light']): void {
    this.light = light;
    this.page.moved();
    this.player.light(light.name, light.turn);
    this.redraw();
  }

  /** Updates the display after other segments were selected. */
  chosen(): void {
    void this.show();
    this.redraw();
  }

  /** Reports an error. */
  showMessage(text: string): void {
    this.page.say(text);
  }

  #changed(parts: readonly FacePart[] = ['shape', 'texture']): void {
    this.#reading.changed(parts);
    void this.show();
    this.redraw();
  }

  /** Puts the face on the figure. During an update only the latest request is kept; intermediate faces are skipped. */
  show(): Promise<void> {
    this.page.moved();
    return this.#showing.show();
  }

  /** Resolves when the stage shows the face as it was changed last. */
  get shownAsItIs(): Promise<void> {
    return this.#showing.done;
  }

  /** Schedules a rendering of the page; several changes are batched. */
  redraw(): void {
    if (this.#drawn !== 0) return;
    this.#drawn = requestAnimationFrame(() => {
      this.#drawn = 0;
      this.page.draw();
    });
  }
}
