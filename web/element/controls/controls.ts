/** Overlays of the image: captions, controls and messages, as templates of the element's state. */

import { html, nothing, type TemplateResult } from 'lit';
import { Directive, directive, type ElementPart } from 'lit/directive.js';
import { classMap } from 'lit/directives/class-map.js';
import type { captionAt } from '../captions/captions.js';
import { formatTime, spokenTime } from '../base/clock.js';
import { captionsButton, type CaptionChoice, type CaptionMenu } from './caption-menu.js';
import type { ControlWords } from './control-words.js';
import { icons } from './icons.js';
import type { Diagnostic, Place } from '../base/types.js';
import type { StoryTextTrack } from '../media/text-track.js';

/** Speeds offered in the menu. */
const SPEEDS = [0.5, 0.75, 1, 1.25, 1.5, 2];

/** State displayed by the bar. */
export interface BarState {
  readonly words: ControlWords;
  /** Language of the words, a BCP 47 tag. */
  readonly language: string;
  readonly paused: boolean;
  readonly ended: boolean;
  readonly position: number;
  readonly duration: number;
  readonly volume: number;
  readonly muted: boolean;
  readonly rate: number;
  readonly captions: boolean;
  /** Captions to choose from, if there is more than one language. */
  readonly choices: readonly CaptionChoice[];
  readonly fullscreen: boolean;
  readonly canFullscreen: boolean;
  readonly gone: boolean;
}

/** Actions of the bar. */
export interface BarActions {
  toggle(): void;
  seekTo(secs: number): void;
  setVolume(volume: number): void;
  setRate(rate: number): void;
  toggleMuted(): void;
  toggleCaptions(): void;
  /** Shows a track, or none. */
  chooseCaptions(track: StoryTextTrack | undefined): void;
  readonly captionMenu: CaptionMenu;
  toggleFullscreen(): void;
}

const number = (event: Event): number => Number((event.target as HTMLInputElement | HTMLSelectElement).value);

/** Sets the filled share of a slider, percent. Lit's styleMap writes an inline style first, which a strict CSP rejects. */
const filled = directive(
  class extends Directive {
    override update(part: ElementPart, [percent]: [number]): void {
      (part.element as HTMLElement).style.setProperty('--_done', `${percent}%`);
    }

    render(_percent: number): void {}
  },
);

/** Renders the control bar. */
export function bar(state: BarState, actions: BarActions): TemplateResult {
  const { position, duration, words, language } = state;
  const share = duration > 0 ? (100 * position) / duration : 0;
  const silent = state.muted || state.volume === 0;
  const playLabel = state.ended ? words.playAgain : state.paused ? words.play : words.pause;
  const playIcon = state.ended ? icons.replay : state.paused ? icons.play : icons.pause;
  const screenLabel = state.fullscreen ? words.leaveFullScreen : words.fullScreen;
  const speeds = SPEEDS.includes(state.rate) ? SPEEDS : [...SPEEDS, state.rate].sort((a, b) => a - b);
  return html`<div class=${classMap({ bar: true, gone: state.gone })} part="controls">
    <input
      class="seek"
      part="seek"
      type="range"
      min="0"
      max=${duration}
      step="0.01"
      .value=${String(position)}
      ${filled(share)}
      aria-label=${words.seek}
      aria-valuetext=${words.of(spokenTime(position, language), spokenTime(duration, language))}
      @input=${(event: Event) => actions.seekTo(number(event))}
    />
    <button part="button play" aria-label=${playLabel} title="${playLabel} (${words.space})" @click=${actions.toggle}>${playIcon}</button>
    <span class="time" part="time">${formatTime(position)} / ${formatTime(duration)}</span>
    <span></span>
    <button
      part="button mute"
      aria-label=${words.mute}
      aria-pressed=${state.muted ? 'true' : 'false'}
      title="${silent ? words.soundOn : words.mute} (M)"
      @click=${actions.toggleMuted}
    >
      ${silent ? icons.silent : icons.loud}
    </button>
    <input
      class="volume"
      part="volume"
      type="range"
      min="0"
      max="1"
      step="0.05"
      .value=${String(silent ? 0 : state.volume)}
      ${filled(silent ? 0 : state.volume * 100)}
      aria-label=${words.volume}
      aria-valuetext=${words.percent(Math.round(silent ? 0 : state.volume * 100))}
      @input=${(event: Event) => actions.setVolume(number(event))}
    />
    <select class="speed" part="speed" aria-label=${words.speed} title=${words.speed} @change=${(event: Event) => actions.setRate(number(event))}>
      ${speeds.map((s) => html`<option value=${s} .selected=${s === state.rate}>${s}×</option>`)}
    </select>
    ${state.choices.length > 0 ? actions.captionMenu.render(words, state.captions, state.choices) : captionsButton(words, state.captions, actions.toggleCaptions)}
    ${
      state.canFullscreen
        ? html`<button
          part="button fullscreen"
          aria-label=${screenLabel}
          title="${screenLabel} (F)"
          @click=${actions.toggleFullscreen}
        >
          ${state.fullscreen ? icons.leave : icons.enter}
        </button>`
        : html`<span></span>`
    }
  </div>`;
}

/** Returns the caption with the spoken word highlighted. */
export function caption(now: ReturnType<typeof captionAt>, language: string): TemplateResult | typeof nothing {
  if (now === undefined) return nothing;
  // A space between words, inside the line: `mark` alone would join them.
  const { words: all, second } = now.caption;
  const words = all.map((w, i) => html`${i === 0 ? nothing : i === second ? html` <br />` : ' '}${i === now.word ? html`<mark part="caption-word">${w.text}</mark>` : w.text}`);
  return html`<div class="captions" part="captions" lang=${language}><span>${words}</span></div>`;
}

/** Returns the current cues of a page's track, in their lines, as plain text. */
export function subtitle(cues: readonly TextTrackCue[], language: string): TemplateResult | typeof nothing {
  const lines = cues.flatMap((cue) => (cue instanceof VTTCue ? (cue.getCueAsHTML().textContent ?? '').split('\n') : [])).filter((line) => line.trim() !== '');
  if (lines.length === 0) return nothing;
  return html`<div class="captions" part="captions" lang=${language} dir="auto"><span>${lines.map((line, i) => html`${i === 0 ? nothing : html`<br />`}${line}`)}</span></div>`;
}

/** Renders the collapsible list of the problems of a story and its figure. */
export function diagnosticList(diagnostics: readonly Diagnostic[]): TemplateResult | typeof nothing {
  if (diagnostics.length === 0) return nothing;
  const errors = diagnostics.filter((d) => d.severity === 'error').length;
  const plural = (n: number, name: string) => `${n} ${name}${n === 1 ? '' : 's'}`;
  const title = [...(errors > 0 ? [plural(errors, 'error')] : []), ...(diagnostics.length > errors ? [plural(diagnostics.length - errors, 'warning')] : [])];
  // Thousands of lines would freeze the page without being of help.
  const most = 50;
  return html`<details class="note" part="diagnostics">
    <summary>${title.join(' and ')}</summary>
    <ol>
      ${diagnostics.slice(0, most).map(
        (d) => html`<li>
          ${d.start ? html`<span class="where">${where(d.start)}</span> ` : nothing}${d.message}
          ${d.hints.map((hint) => html`<span class="hint">${hint}</span>`)}
        </li>`,
      )}
      ${diagnostics.length > most ? html`<li>… and ${diagnostics.length - most} more.</li>` : nothing}
    </ol>
  </details>`;
}

const where = (place: Place): string => `Line ${place.line}, column ${place.column}:`;

/** Renders the message for a story that cannot be played at all. */
export function failure(words: ControlWords, message: string, retry: () => void): TemplateResult {
  return html`<div class="failure" part="error" role="alert">
    <p><strong>${words.untold}</strong>${message}</p>
    <button part="button retry" @click=${retry}>${words.tryAgain}</button>
  </div>`;
}

/** Returns the message for a lost rendering context: the story continues, and a film may replace the image. */
export function pictureLost(words: ControlWords, recovering: boolean, hasFilm: boolean, retry: () => void): TemplateResult {
  return html`<div class="note" part="picture-lost">
    ${hasFilm ? words.filmShown : words.pictureLost}
    ${recovering ? words.bringingBack : html`<button part="button retry" @click=${retry}>${hasFilm ? words.tryToDraw : words.bringBack}</button>`}
  </div>`;
}

/** Renders the big button that is shown before a story begins and after it ends. */
export function bigButton(words: ControlWords, ended: boolean, play: (event: MouseEvent) => void): TemplateResult {
  return html`<div class="overlay">
    <button part="big-play" aria-label=${ended ? words.playStoryAgain : words.playStory} @click=${play}>
      <span class="disc">${ended ? icons.replay : icons.play}</span>
    </button>
  </div>`;
}

/** Returns the progress of loading. */
export function loadingProgress(words: ControlWords, share: number): TemplateResult {
  return html`<div class="progress">
    <progress max="1" .value=${share} aria-label=${words.loading}></progress>
    <span>${words.gettingReady}</span>
  </div>`;
}

/** Renders the ring that is shown while audio is not available yet. */
export function waitingRing(): TemplateResult {
  return html`<div class="progress"><span class="ring"></span></div>`;
}
