/** The tracks on the time axis: a grid for the keyboard, of which only the spans in view are drawn. */

import { html, nothing, render, type TemplateResult } from 'lit';
import { repeat } from 'lit/directives/repeat.js';
import { follow, vars } from '../fields.js';
import type { App } from './app.js';
import { clock, fitted, marks, revealed, toOf, zoomed, type AxisView } from './axis.js';
import type { Side } from './edges.js';
import { inView, nearest, neighbour, type Span, type Track } from './tracks.js';
import { isSame, type Item } from './types.js';

/** Time by which a key moves an edge, seconds. */
const STEP_SECS = 0.01;
/** Scale at which most phases have room for their names, pixels per second. */
const LEGIBLE_SCALE = 80;
/** Factor of the zoom buttons and keys. */
const ZOOM = 1.5;
/** Width from which a span has edges to drag, pixels. */
const EDGES_PX = 28;
/** Width of a span below which others hide it, pixels. */
const MIN_PX = 2;
/** Width from which a span has its text, pixels. */
const LABEL_PX = 18;
/** Share of the view after which it follows the needle during playback. */
const TURN = 0.92;

export class Lanes {
  readonly #scroller: HTMLElement;
  readonly #app: App;
  readonly #say: (text: string) => void;
  /** Pixels per second; undefined: the whole length in view. */
  #scale: number | undefined = LEGIBLE_SCALE;
  #name = '';

  constructor(app: App, scroller: HTMLElement, say: (text: string) => void) {
    this.#app = app;
    this.#scroller = scroller;
    this.#say = say;
    scroller.addEventListener('scroll', () => this.#draw());
    scroller.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    new ResizeObserver(() => this.draw()).observe(scroller);
  }

  // --- view ---

  /** Width of the track names, pixels. */
  get #names(): number {
    return parseFloat(getComputedStyle(this.#scroller).getPropertyValue('--names')) || 0;
  }

  get view(): AxisView {
    const width = Math.max(1, this.#scroller.clientWidth - this.#names);
    const scale = Math.max(this.#scale ?? 0, fitted(this.#app.lengthSecs, width));
    return { width, scale, from: this.#scroller.scrollLeft / scale };
  }

  /** Changes the scale by a factor about a position, pixels from the left end; by default about the needle, or the middle. */
  zoom(factor: number, at?: number): void {
    const { view } = this;
    const needle = (this.#app.playback.secs - view.from) * view.scale;
    const about = at ?? (needle >= 0 && needle <= view.width ? needle : view.width / 2);
    const next = zoomed(view, factor, about, this.#app.lengthSecs);
    this.#scale = next.scale;
    // The content has its new width before it is scrolled.
    this.#draw();
    this.#scroller.scrollLeft = next.from * next.scale;
    this.#draw();
  }

  /** Shows the whole length. */
  fit(): void {
    this.#scale = undefined;
    this.#scroller.scrollLeft = 0;
    this.#draw();
  }

  zoomButtons(): TemplateResult {
    return html`<button type="button" class="plain" @click=${() => this.zoom(ZOOM)} aria-label="Zoom in">+</button>
      <button type="button" class="plain" @click=${() => this.zoom(1 / ZOOM)} aria-label="Zoom out">−</button>
      <button type="button" class="plain" @click=${() => this.fit()}>All</button>`;
  }

  /** Scrolls a span, or a time, into view. */
  reveal(start: number, end = start): void {
    const { view } = this;
    const from = revealed(view, start, end, this.#app.lengthSecs);
    if (from !== view.from) this.#scroller.scrollLeft = from * view.scale;
  }

  /** Selects a span, shows it and gives it the focus. */
  go(item: Item): void {
    this.#app.select(item);
    const { span } = this.#app;
    if (span !== undefined) this.reveal(span.start, span.end);
    this.#draw();
    this.focus();
  }

  /** Gives the selected span the focus. */
  focus(): void {
    this.#scroller.querySelector<HTMLElement>('[role="gridcell"][tabindex="0"]')?.focus({ preventScroll: true });
  }

  #wheel(event: WheelEvent): void {
    if (!event.ctrlKey) return;
    event.preventDefault();
    this.zoom(Math.exp(-event.deltaY * 0.004), event.clientX - this.#scroller.getBoundingClientRect().left - this.#names);
  }

  // --- drawing ---

  draw(): void {
    // A short annotation is seen whole at first, and the beginning of a long one so that it can be read.
    if (this.#name !== this.#app.name) {
      this.#name = this.#app.name;
      this.#scale = LEGIBLE_SCALE;
      this.#scroller.scrollLeft = 0;
    }
    this.#draw();
  }

  /** Moves the needle, and the view with it during playback. */
  keepUp(): void {
    const { view } = this;
    const at = this.#app.playback.secs;
    const x = (at - view.from) * view.scale;
    if (!this.#app.playback.paused && (x < 0 || x > TURN * view.width)) this.#scroller.scrollLeft = (at - 0.05 * (view.width / view.scale)) * view.scale;
    this.#scroller.style.setProperty('--needle', `${(at * view.scale).toFixed(1)}px`);
  }

  #draw(): void {
    const { view } = this;
    this.#scroller.style.setProperty('--width', `${Math.round(this.#app.lengthSecs * view.scale)}px`);
    const { tracks, span } = this.#app;
    // Without a selection, the key Tab leads to the first span in view.
    const current = span?.item ?? tracks.map(({ spans }) => nearest(spans, view.from)).find((item) => item !== undefined);
    render(
      html`<div class="content">
        <div class="ruler" @pointerdown=${(event: PointerEvent) => this.#scrub(event)} aria-hidden="true">
          <span class="lane-name"></span>
          <div class="lane">${marks(view).map(({ secs, text }) => html`<span class="mark" ${vars({ '--at': `${secs * view.scale}px` })}>${text}</span>`)}</div>
        </div>
        <div
          role="grid"
          aria-label="Tracks"
          aria-describedby="keys"
          @click=${(event: Event) => this.#click(event)}
          @pointerdown=${(event: PointerEvent) => this.#press(event)}
          @keydown=${(event: KeyboardEvent) => this.#key(event)}
        >
          ${tracks.map((track) => this.#row(track, view, current))}
        </div>
        <div class="needle" aria-hidden="true"></div>
      </div>`,
      this.#scroller,
    );
    this.keepUp();
  }

  #row(track: Track, view: AxisView, current: Item | undefined): TemplateResult {
    const shown = inView(track.spans, view.from, toOf(view), MIN_PX / view.scale, current);
    return html`<div role="row">
      <span class="lane-name" role="rowheader" title=${track.name}>${track.name}</span>
      <div class="lane" role="presentation">
        ${repeat(
          shown,
          ({ item }) => item.index,
          (span) => this.#cell(track, span, view, current),
        )}
      </div>
    </div>`;
  }

  #cell(track: Track, span: Span, { scale }: AxisView, current: Item | undefined): TemplateResult {
    const { item, start, end, label, look } = span;
    const isChosen = isSame(item, this.#app.selected);
    const width = (end - start) * scale;
    return html`<div
      role="gridcell"
      class="span ${look} ${isChosen ? 'chosen' : ''}"
      tabindex=${isSame(item, current) ? 0 : -1}
      aria-selected=${isChosen ? 'true' : 'false'}
      aria-label="${track.name}: ${label}, ${clock(start)} to ${clock(end)} s"
      title="${label}, ${clock(start)} to ${clock(end)} s"
      data-track=${item.track}
      data-index=${item.index}
      ${vars({ '--at': `${(start * scale).toFixed(2)}px`, '--long': `${Math.max(2, width).toFixed(2)}px` })}
    >
      <span class="label" aria-hidden="true">${width < LABEL_PX ? nothing : label}</span>
      ${isChosen || width >= EDGES_PX ? html`<span class="edge start" data-side="start"></span><span class="edge end" data-side="end"></span>` : nothing}
    </div>`;
  }

  // --- pointer ---

  #itemAt(event: Event): Item | undefined {
    const cell = (event.target as Element).closest<HTMLElement>('[role="gridcell"]');
    const { track, index } = cell?.dataset ?? {};
    return track === undefined ? undefined : { track, index: Number(index) };
  }

  #click(event: Event): void {
    const item = this.#itemAt(event);
    if (item === undefined || (event.target as HTMLElement).dataset['side'] !== undefined) return;
    this.#app.select(item);
  }

  /** Drags an edge. */
  #press(event: PointerEvent): void {
    const side = (event.target as HTMLElement).dataset['side'] as Side | undefined;
    const item = this.#itemAt(event);
    const lane = (event.target as Element).closest('.lane');
    if (side === undefined || item === undefined || lane === null) return;
    const held = this.#app.hold(item, side);
    this.#app.selected = item;
    this.#app.redraw();
    if (held === undefined) return;
    // Where the edge was pressed beside its time.
    const { span } = this.#app;
    const beside = event.clientX - lane.getBoundingClientRect().left - (span?.[side] ?? 0) * this.view.scale;
    follow(
      event,
      lane,
      ({ x }) => held.move((x - beside) / this.view.scale),
      () => this.#app.done(),
    );
  }

  #scrub(event: PointerEvent): void {
    const lane = (event.currentTarget as Element).querySelector('.lane');
    if (lane === null) return;
    const seek = (x: number): void => this.#app.seek(Math.max(0, x / this.view.scale));
    seek(event.clientX - lane.getBoundingClientRect().left);
    follow(
      event,
      lane,
      ({ x }) => seek(x),
      () => undefined,
    );
  }

  // --- keyboard ---

  #key(event: KeyboardEvent): void {
    const item = this.#itemAt(event);
    if (item === undefined || event.ctrlKey || event.metaKey) return;
    if (event.altKey) {
      const step = { ArrowLeft: -STEP_SECS, ArrowRight: STEP_SECS }[event.key];
      if (step === undefined) return;
      this.#move(item, event.shiftKey ? 'start' : 'end', step);
    } else if (event.key === 'Enter') {
      this.#app.select(item);
      // The panel has its fields before the focus goes there.
      requestAnimationFrame(() => document.querySelector<HTMLElement>('#panel > :is(.select, .check) :is(input, select)')?.focus());
    } else if (event.key === '+' || event.key === '-') {
      this.zoom(event.key === '+' ? ZOOM : 1 / ZOOM);
    } else {
      const next = neighbour(this.#app.tracks, item, event.key);
      if (next === undefined) return;
      this.go(next);
    }
    event.preventDefault();
  }

  #move(item: Item, side: Side, step: number): void {
    this.#app.selected = item;
    const { span } = this.#app;
    if (span === undefined) return;
    const at = this.#app.moveEdge(item, side, span[side] + step);
    if (at !== undefined) this.#say(`${side === 'start' ? 'Start' : 'End'} at ${clock(at)} s`);
  }
}
