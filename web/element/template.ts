/** Template of the whole element, from its state. */

import { html, nothing, type TemplateResult } from 'lit';
import { classMap } from 'lit/directives/class-map.js';
import type { captionAt } from './captions/captions.js';
import { controlLanguage, wordsFor } from './story/context.js';
import { nameOf, type CaptionChoice } from './controls/caption-menu.js';
import * as controls from './controls/controls.js';
import type { RaconteurPlayer } from './element.js';
import type { Idle } from './controls/idle.js';
import type { Questioner } from './lesson/questioner.js';
import { hasCaptions, type Show } from './story/show.js';
import type { StoryLoader } from './story/story-loader.js';

/** State read by the template in addition to the element's own properties. */
export interface TemplateState {
  readonly player: RaconteurPlayer;
  readonly show: Show | undefined;
  readonly stories: StoryLoader;
  readonly idle: Idle;
  /** True if the story was played or sought. */
  readonly started: boolean;
  /** Film shown instead of a picture. */
  readonly film: HTMLVideoElement | undefined;
  /** Another figure is being fetched. */
  readonly changing: boolean;
  readonly questioner: Questioner;
  readonly caption: ReturnType<typeof captionAt>;
  readonly announcement: string;
}

export function template(state: TemplateState, actions: controls.BarActions): TemplateResult {
  const { player, show, stories, idle, started, film, questioner } = state;
  const words = wordsFor(player);
  const before = (show !== undefined || stories.waits) && player.paused && (!started || player.ended) && questioner.lesson.asked === undefined;
  const shown = show !== undefined && stories.lost === 'no';
  // The events that a film stands in for fire even if nobody watches it.
  const told = film === undefined || player.paused || !idle.is;
  const poster = !started || (stories.lost === 'yes' && film === undefined);
  return html`<div class="frame" tabindex="0" role="group" aria-label=${words.player}>
      <div class=${classMap({ stage: true, shown, 'hide-cursor': idle.is })} part="stage" @pointerdown=${(event: PointerEvent) => idle.tap(event, player.paused)} @click=${() => (show ?? stories.waits) && !idle.tapWoke && actions.toggle()}>
        ${film ?? stories.canvas}
      </div>
      ${player.poster && poster ? html`<img class="poster" part="poster" src=${player.poster} alt="" />` : nothing}
      ${stories.share === undefined ? nothing : controls.loadingProgress(words, stories.share)}
      ${show?.transport.waiting || state.changing ? controls.waitingRing() : nothing}
      ${before ? controls.bigButton(words, player.ended, (event) => begin(player, actions, event)) : nothing}
      ${hasCaptions(player, show) && (isForeign(player) || (show?.captions.length ?? 0) > 0) ? html`<div class="caption-room"></div>` : nothing}
      <div class="lower">
        ${hasCaptions(player, show) && !before && questioner.lesson.asked === undefined ? text(state) : nothing}
        ${show && player.controls ? bar(player, show, idle, actions) : nothing}
      </div>
      ${questioner.form.render(questioner.lesson.asked)}
      <div class="notes">
        ${stories.lost !== 'no' && told ? controls.pictureLost(words, stories.lost === 'recovering', film !== undefined, () => void show?.picture.recover(true)) : nothing}
        ${player.remarks && (player.paused || !idle.is) ? controls.diagnosticList(player.diagnostics) : nothing}
      </div>
      ${player.error ? controls.failure(words, player.error.message, () => void player.load()) : nothing}
      <div class="unseen" role="status">${state.announcement}</div>
    </div>
    ${questioner.lesson.asked === undefined ? nothing : html`<div class="growth"></div>`}`;
}

/** True if tracks of the page are shown instead of the story's own captions. */
const isForeign = ({ textTracks: { shown, own } }: RaconteurPlayer): boolean => shown.some((track) => track !== own);

/** Returns the texts of the tracks that are shown. */
function text({ player, caption }: TemplateState): unknown {
  const { shown, own } = player.textTracks;
  return isForeign(player) ? shown.map(({ activeCues, language }) => controls.subtitle(activeCues ?? [], language)) : controls.caption(caption, own?.language ?? '');
}

/** Starts the story and moves the focus from the vanishing button, so that keyboard users can continue. */
function begin(player: RaconteurPlayer, actions: controls.BarActions, { detail }: MouseEvent): void {
  actions.toggle();
  if (detail === 0) player.focus({ preventScroll: true });
}

function bar(player: RaconteurPlayer, show: Show, idle: Idle, actions: controls.BarActions): TemplateResult {
  return controls.bar(
    {
      words: wordsFor(player),
      language: controlLanguage(player),
      paused: player.paused,
      ended: player.ended,
      position: player.currentTime,
      duration: show.transport.endSecs,
      volume: player.volume,
      muted: player.muted,
      rate: show.transport.rate,
      captions: hasCaptions(player, show),
      choices: choicesOf(player, actions),
      fullscreen: document.fullscreenElement === player,
      canFullscreen: document.fullscreenEnabled,
      gone: idle.is && !player.paused,
    },
    actions,
  );
}

/** Returns the captions to choose from: none, or one of the tracks; empty if there is only the story's own. */
function choicesOf(player: RaconteurPlayer, { chooseCaptions }: controls.BarActions): CaptionChoice[] {
  const { shown, own, texts } = player.textTracks;
  if (texts.length < 2) return [];
  const words = wordsFor(player);
  const tracks = texts.map((track) => {
    const name = nameOf(track.language);
    const isNamed = track !== own && track.label !== '';
    return {
      label: isNamed ? track.label : name || words.captions,
      language: isNamed || !name ? undefined : track.language,
      isChosen: shown.includes(track),
      choose: () => chooseCaptions(track),
    };
  });
  return [{ label: words.noCaptions, language: undefined, isChosen: shown.length === 0, choose: () => chooseCaptions(undefined) }, ...tracks];
}
