/** The place of the recording: files to open, and the recording itself once there is one. */

import { html, nothing, type TemplateResult } from 'lit';
import { refusal } from './problems.js';
import type { Problem } from './types.js';

/** Endings of recordings whose type a system does not know. */
const RECORDINGS = /\.(mp4|m4v|mov|webm|ogv|mkv|avi|mpe?g|mp3|m4a|wav|ogg|oga|opus|flac)$/i;
/** Endings that a file dialogue offers. */
const ANNOTATIONS = '.anvil,.eaf,.xml';

/** Files that a visitor chose or dropped. */
export interface ChosenFiles {
  readonly annotation: File | undefined;
  readonly recording: File | undefined;
}

/** Tells recordings and annotations apart. */
export function chosen(files: Iterable<File>): ChosenFiles {
  const all = [...files];
  const isRecording = ({ type, name }: File): boolean => /^(video|audio)\//.test(type) || RECORDINGS.test(name);
  return { annotation: all.find((file) => !isRecording(file)), recording: all.find(isRecording) };
}

/** State of the opening. */
export interface Opening {
  /** True if an annotation is open. */
  readonly hasAnnotation: boolean;
  /** Name of the recording. */
  readonly recording: string;
  /** True if it has no picture. */
  readonly isSound: boolean;
  readonly mapping: string;
  /** Name of the annotation that was closed; empty if there is none. */
  readonly closed: string;
  /** File that could not be opened, and why. */
  readonly refused: { readonly name: string; readonly problems: readonly Problem[] } | undefined;
}

/** Actions of the opening. */
export interface OpeningActions {
  files(files: Iterable<File>): void;
  example(): void;
  reopen(): void;
  mapping(text: string): void;
  removeRecording(): void;
}

/** Renders a button that opens a file dialogue. */
export function fileButton(label: string, accept: string, open: (files: Iterable<File>) => void, classes = 'plain', isMultiple = false): TemplateResult {
  const take = (event: Event): void => {
    const input = event.target as HTMLInputElement;
    open([...(input.files ?? [])]);
    // The same file may be chosen again: it may have been mended.
    input.value = '';
  };
  return html`<label class="file ${classes}"><input type="file" class="unseen" accept=${accept} ?multiple=${isMultiple} @change=${take} /><span>${label}</span></label>`;
}

export const annotationButton = (open: (files: Iterable<File>) => void, classes?: string): TemplateResult =>
  fileButton('Open an annotation…', `${ANNOTATIONS},video/*,audio/*`, open, classes, true);

const recordingButton = (open: (files: Iterable<File>) => void): TemplateResult => fileButton('Open a recording…', 'video/*,audio/*', open);

/** Renders the content of the place of the recording. */
export function opening(state: Opening, actions: OpeningActions): TemplateResult {
  const { hasAnnotation, recording, isSound, refused, closed } = state;
  const trouble = refused === undefined ? nothing : html`<div class="refused" role="alert">${refusal(refused.name, refused.problems)}</div>`;
  if (recording !== '') {
    return html`${trouble}${isSound ? html`<div class="drop">Sound without a picture</div>` : nothing}<p class="named"><span>${recording}</span><button type="button" class="plain" @click=${() => actions.removeRecording()}>Remove</button></p>`;
  }
  const note = 'It stays on your machine and is not kept: open it again after a reload.';
  if (hasAnnotation) {
    return html`<div class="drop">${trouble}<p>Drop the recording here, video or audio.</p>${recordingButton((files) => actions.files(files))}<p class="fine">${note}</p></div>`;
  }
  return html`<div class="drop">
    ${trouble}
    <p>Drop an annotation here, and with it its recording if you have one.</p>
    <div class="group">
      ${annotationButton((files) => actions.files(files), 'play')}
      ${closed === '' ? nothing : html`<button type="button" class="plain" @click=${() => actions.reopen()}>Back to ${closed}</button>`}
      <button type="button" class="plain" @click=${() => actions.example()}>Try an example</button>
    </div>
    <p class="fine">Nothing is uploaded.</p>
    <details>
      <summary>Names of ELAN’s tiers</summary>
      <label class="select"><span>Tracks of GestuRA = tiers of the file; without this, they are guessed</span>
        <textarea rows="4" spellcheck="false" placeholder="words = W-Spch" .value=${state.mapping} @input=${(event: Event) => actions.mapping((event.target as HTMLTextAreaElement).value)}></textarea></label>
    </details>
  </div>`;
}
