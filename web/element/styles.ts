/** The look of the element. A page changes it through `--raconteur-*` and `::part()`. */

import { css } from 'lit';

export const styles = css`
  :host {
    --_accent: var(--raconteur-accent, #f2b25c);
    --_control: var(--raconteur-control-color, #fdf6ea);
    --_ground: var(--raconteur-background, #1d1826);
    --_radius: var(--raconteur-radius, 0px);
    --_bar: var(--raconteur-bar-background, rgb(18 13 24 / 78%));
    display: block;
    position: relative;
    aspect-ratio: 16 / 9;
    overflow: hidden;
    container-type: size;
    border-radius: var(--_radius);
    background: var(--_ground);
    color: var(--_control);
    font: 500 15px/1.4 system-ui, sans-serif;
    -webkit-tap-highlight-color: transparent;
  }
  :host([hidden]) {
    display: none;
  }
  :host(:focus) {
    outline: none;
  }
  :host(:focus-visible) {
    outline: 3px solid var(--_accent);
    outline-offset: 3px;
  }
  :host(:fullscreen) {
    border-radius: 0;
  }
  .stage,
  .stage canvas,
  .poster {
    position: absolute;
    inset: 0;
    width: 100%;
    height: 100%;
    display: block;
  }
  .stage {
    /* What is there before the first picture: a lit backdrop. */
    background: radial-gradient(120% 100% at 50% 18%, rgb(255 226 180 / 16%), transparent 62%), var(--_ground);
  }
  .stage canvas {
    opacity: 0;
    transition: opacity 0.5s ease-out;
  }
  .stage.shown canvas {
    opacity: 1;
  }
  .poster {
    object-fit: cover;
  }
  .hide-cursor {
    cursor: none;
  }
  button,
  select {
    font: inherit;
    color: inherit;
    background: none;
    border: 0;
    margin: 0;
    padding: 0;
    cursor: pointer;
  }
  svg {
    fill: currentcolor;
    display: block;
  }
  :is(button, select, input, summary):focus-visible {
    outline: 2px solid var(--_accent);
    outline-offset: 2px;
    border-radius: 8px;
  }

  /* The big button over the picture. */
  .overlay {
    position: absolute;
    inset: 0;
    display: grid;
    place-items: center;
  }
  .overlay > button {
    position: absolute;
    inset: 0;
    width: 100%;
    display: grid;
    place-items: center;
  }
  .overlay .disc {
    display: grid;
    place-items: center;
    width: clamp(60px, 14cqmin, 92px);
    aspect-ratio: 1;
    border-radius: 50%;
    background: var(--_accent);
    color: #241708;
    box-shadow: 0 6px 30px rgb(0 0 0 / 40%);
    transition: transform 0.18s ease-out;
  }
  .overlay .disc svg {
    width: 54%;
    height: 54%;
  }
  .overlay button:hover .disc {
    transform: scale(1.07);
  }
  .overlay button:focus-visible {
    outline: none;
  }
  .overlay button:focus-visible .disc {
    outline: 3px solid var(--_control);
    outline-offset: 4px;
  }
  .progress {
    position: absolute;
    left: 50%;
    top: 50%;
    translate: -50% -50%;
    display: grid;
    justify-items: center;
    gap: 12px;
    font-size: 14px;
    color: color-mix(in srgb, var(--_control) 85%, transparent);
    pointer-events: none;
  }
  .progress progress {
    width: clamp(120px, 34cqw, 240px);
    height: 4px;
    appearance: none;
    border: 0;
    border-radius: 2px;
    overflow: hidden;
    background: rgb(255 255 255 / 20%);
  }
  .progress progress::-webkit-progress-bar {
    background: rgb(255 255 255 / 20%);
  }
  .progress progress::-webkit-progress-value {
    background: var(--_accent);
  }
  .progress progress::-moz-progress-bar {
    background: var(--_accent);
  }
  .ring {
    width: 44px;
    aspect-ratio: 1;
    border-radius: 50%;
    border: 4px solid rgb(255 255 255 / 25%);
    border-top-color: var(--_accent);
    animation: turn 0.9s linear infinite;
  }
  @keyframes turn {
    to {
      rotate: 1turn;
    }
  }

  /* Captions. */
  .lower {
    position: absolute;
    inset: auto 0 0;
    display: grid;
    pointer-events: none;
  }
  .lower > * {
    pointer-events: auto;
  }
  .captions {
    justify-self: center;
    max-width: min(94%, 42em);
    margin: 0 auto clamp(8px, 2.4cqh, 20px);
    font-size: var(--raconteur-caption-size, clamp(15px, 2.5cqw, 24px));
    line-height: 1.62;
    text-align: center;
    text-wrap: balance;
    pointer-events: none;
    transition: translate 0.2s;
  }
  /* Captions take the place of controls that are hidden: hands gesture where they were. */
  .captions:has(+ .bar.gone) {
    translate: 0 60px;
  }
  /* The ground hugs each line, as on television. */
  .captions > span {
    padding: 0.14em 0.55em 0.2em;
    border-radius: 0.4em;
    background: var(--raconteur-caption-background, rgb(14 10 18 / 78%));
    color: var(--raconteur-caption-color, #fffaf0);
    -webkit-box-decoration-break: clone;
    box-decoration-break: clone;
  }
  .captions mark {
    background: none;
    color: var(--raconteur-caption-word, var(--_accent));
    /* Not by colour alone; and no change of width, so that lines do not jump. */
    text-decoration: underline;
    text-decoration-thickness: 0.09em;
    text-underline-offset: 0.2em;
  }

  /* The bar of controls. */
  .bar {
    display: grid;
    grid-template-columns: auto auto 1fr auto auto auto auto auto;
    align-items: center;
    gap: 2px 4px;
    padding: 4px clamp(6px, 1.6cqw, 16px) clamp(4px, 1cqw, 10px);
    background: linear-gradient(to top, var(--_bar), rgb(18 13 24 / 55%));
    transition: opacity 0.2s;
  }
  .bar.gone {
    opacity: 0;
    pointer-events: none;
  }
  .bar button {
    display: grid;
    place-items: center;
    min-width: 40px;
    height: 40px;
    border-radius: 10px;
  }
  .bar button:hover,
  .bar select:hover {
    background: rgb(255 255 255 / 14%);
  }
  .bar button[aria-pressed='true'] {
    color: var(--_accent);
  }
  .seek {
    grid-column: 1 / -1;
  }
  .time {
    padding: 0 6px;
    font-size: 14px;
    font-variant-numeric: tabular-nums;
    white-space: nowrap;
  }
  .speed {
    height: 40px;
    padding: 0 6px;
    border-radius: 10px;
    font-size: 14px;
    text-align: center;
    appearance: none;
  }
  .speed option {
    color: #1b1420;
    background: #fff;
  }
  input[type='range'] {
    --_done: 0%;
    appearance: none;
    width: 100%;
    height: 22px;
    margin: 0;
    background: none;
    cursor: pointer;
  }
  .volume {
    max-width: 84px;
    min-width: 56px;
  }
  input[type='range']::-webkit-slider-runnable-track {
    height: 5px;
    border-radius: 3px;
    background: linear-gradient(to right, var(--_accent) var(--_done), rgb(255 255 255 / 30%) var(--_done));
  }
  input[type='range']::-moz-range-track {
    height: 5px;
    border-radius: 3px;
    background: linear-gradient(to right, var(--_accent) var(--_done), rgb(255 255 255 / 30%) var(--_done));
  }
  input[type='range']::-webkit-slider-thumb {
    appearance: none;
    width: 15px;
    aspect-ratio: 1;
    margin-top: -5px;
    border-radius: 50%;
    background: var(--_control);
  }
  input[type='range']::-moz-range-thumb {
    width: 15px;
    height: 15px;
    border: 0;
    border-radius: 50%;
    background: var(--_control);
  }

  /* Messages over the picture. */
  .notes {
    position: absolute;
    inset: clamp(8px, 2cqh, 16px) clamp(8px, 2cqw, 16px) auto;
    display: grid;
    justify-items: start;
    gap: 8px;
    max-height: calc(100% - 110px);
    pointer-events: none;
  }
  .note {
    max-width: min(100%, 34em);
    min-height: 0;
    overflow: auto;
    padding: 6px 12px;
    border-radius: 12px;
    background: rgb(22 16 28 / 88%);
    color: #fdf6ea;
    font-size: 14px;
    pointer-events: auto;
  }
  .note button,
  .failure button {
    padding: 3px 10px;
    margin-inline-start: 8px;
    border-radius: 8px;
    background: var(--_accent);
    color: #241708;
    font-weight: 600;
  }
  details summary {
    cursor: pointer;
  }
  details ol {
    margin: 8px 0 4px;
    padding: 0;
    list-style: none;
    display: grid;
    gap: 8px;
  }
  .where {
    font-variant-numeric: tabular-nums;
    color: var(--_accent);
  }
  .hint {
    display: block;
    opacity: 0.85;
  }
  .failure {
    position: absolute;
    inset: 0;
    display: grid;
    place-content: center;
    justify-items: center;
    gap: 14px;
    padding: 24px;
    background: var(--_ground);
    color: var(--_control);
    text-align: center;
    text-wrap: balance;
  }
  .failure p {
    margin: 0;
    max-width: 34em;
  }
  .failure strong {
    display: block;
    margin-bottom: 4px;
    font-size: 1.2em;
  }
  .failure button {
    margin: 0;
    padding: 8px 18px;
    border-radius: 10px;
  }
  .unseen {
    position: absolute;
    width: 1px;
    height: 1px;
    overflow: hidden;
    clip-path: inset(50%);
    white-space: nowrap;
  }

  @container (width < 480px) {
    .volume {
      display: none;
    }
    .bar {
      grid-template-columns: auto auto 1fr auto auto auto auto;
      gap: 0;
    }
  }
  @media (prefers-reduced-motion: reduce) {
    .stage canvas,
    .captions,
    .bar,
    .overlay .disc {
      transition: none;
    }
    .ring {
      animation-duration: 3s;
    }
  }
  @media (forced-colors: active) {
    .captions mark {
      forced-color-adjust: none;
    }
    svg {
      fill: ButtonText;
    }
  }
`;
