/** The panel of the selected annotation: its attributes as fields, with their problems at the place. */

import { html, nothing, type TemplateResult } from 'lit';
import { live } from 'lit/directives/live.js';
import type { App } from './app.js';
import { clock } from './axis.js';
import type { Side } from './edges.js';
import { annotationAt, kindOf, type Span } from './tracks.js';
import { isSame, type Item, type Problem } from './types.js';

/** Kinds of fields: a list of words, GSL, a text of one line or several, and yes or no. */
type Field = { readonly name: string; readonly label: string } & (
  | { readonly kind: 'list'; readonly words: readonly string[]; readonly isRequired?: boolean }
  | { readonly kind: 'number'; readonly words: readonly number[] }
  | { readonly kind: 'gsl' | 'text' | 'choice'; readonly hint?: string; readonly isLong?: boolean }
);

const CONFIDENCE: Field = { kind: 'number', name: 'confidence', label: 'Confidence', words: [1, 2, 3, 4] };

const TITLES: Readonly<Record<string, string>> = {
  words: 'Word',
  utterances: 'Utterance',
  levels: 'Discourse level',
  gestures: 'Gesture',
  phases: 'Phase',
  phrases: 'Phrase',
};

/** Returns the fields of the annotations of a track. */
function fieldsOf(app: App, kind: string, dimension: string | undefined): readonly Field[] {
  const { lists } = app;
  switch (kind) {
    case 'words':
      return [{ kind: 'text', name: 'token', label: 'Word' }];
    case 'utterances':
      return [{ kind: 'text', name: 'text', label: 'Text' }];
    case 'levels':
      return [{ kind: 'list', name: 'level', label: 'Level', words: lists.levels, isRequired: true }];
    case 'gestures':
      return [
        { kind: 'list', name: 'class', label: 'Class', words: lists.classes, isRequired: true },
        CONFIDENCE,
        { kind: 'text', name: 'animation', label: 'Animation', hint: 'such as wave' },
      ];
    case 'phases':
      return [
        { kind: 'list', name: 'kind', label: 'Kind', words: lists.phases, isRequired: true },
        { kind: 'gsl', name: 'handShapes', label: 'Hand shapes', hint: '24' },
        { kind: 'gsl', name: 'palmOrientations', label: 'Palm orientations', hint: '[90;[0;1;0]]', isLong: true },
        { kind: 'gsl', name: 'motion', label: 'Motion', hint: '[[-7;12;12];[-9;20;12]]', isLong: true },
        { kind: 'gsl', name: 'source', label: 'Source', hint: '[-7;12;12]' },
        { kind: 'gsl', name: 'target', label: 'Target', hint: '[-9;20;12]' },
        { kind: 'text', name: 'bodyShape', label: 'Body' },
      ];
    default:
      return phraseFields(app, dimension);
  }
}

/** Returns the fields of a phrase: those of its meaning depend on the dimension. */
function phraseFields({ lists }: App, dimension: string | undefined): readonly Field[] {
  const text = (name: string, label: string): Field => ({ kind: 'text', name, label });
  const meaning: Readonly<Record<string, readonly Field[]>> = {
    iconic: [
      text('iconicBody', 'The hand stands for'),
      text('iconicMotion', 'The motion stands for'),
      { kind: 'list', name: 'iconicViewpoint', label: 'Viewpoint', words: lists.viewpoints },
    ],
    metaphoric: [text('metaphoricBase', 'Base'), text('metaphoricReferent', 'Referent'), text('metaphoricMotion', 'The motion stands for')],
    deictic: [text('deicticGeographicTarget', 'Place'), text('deicticNarrationTarget', 'Stands for')],
  };
  return [
    { kind: 'list', name: 'dimension', label: 'Dimension', words: lists.dimensions },
    { kind: 'list', name: 'handedness', label: 'Hands', words: lists.hands },
    { kind: 'choice', name: 'symmetry', label: 'The hands mirror each other' },
    CONFIDENCE,
    text('contribution', 'Adds to the speech'),
    ...(meaning[dimension ?? ''] ?? []),
    text('speakerFramePosition', 'Speaker’s position'),
  ];
}

/** Renders the panel. */
export function panel(app: App): TemplateResult {
  const { span, transcription } = app;
  const annotation = span && transcription && annotationAt(transcription, span.item);
  if (span === undefined || annotation === undefined) return html`<h2>Annotation</h2><p class="fine">Select a span of a track to see and change what it says.</p>`;
  const { kind } = kindOf(span.item.track);
  const values = annotation as unknown as Readonly<Record<string, string | number | boolean | undefined>>;
  const dimension = values['dimension'];
  const problems = app.problems.filter(({ item }) => item !== undefined && isSame(item, span.item));
  const fields = fieldsOf(app, kind, typeof dimension === 'string' ? dimension : undefined);
  return html`<h2>${TITLES[kind]} ${span.item.index + 1}, ${(span.end - span.start).toFixed(2)} s</h2>
    <div class="times">${time(app, span, 'start')} ${time(app, span, 'end')}</div>
    ${fields.map((field) =>
      input(
        app,
        span.item,
        field,
        values[field.name],
        problems.filter((problem) => problem.field === field.name),
      ),
    )}
    ${problems.filter((problem) => problem.field === undefined).map((problem) => html`<p class=${problem.severity}>${problem.message}</p>`)}`;
}

function time(app: App, span: Span, side: Side): TemplateResult {
  const move = (event: Event): void => {
    const input = event.target as HTMLInputElement;
    const secs = Number(input.value);
    if (input.value !== '') app.moveEdge(span.item, side, secs);
    // What the neighbours did not allow is taken back.
    input.value = app.span?.[side].toFixed(2) ?? '';
  };
  const label = side === 'start' ? 'Start' : 'End';
  return html`<label class="select"><span>${label}, s</span><input type="number" step="0.01" min="0" title=${clock(span[side])} .value=${live(span[side].toFixed(2))} @change=${move} /></label>`;
}

function input(app: App, item: Item, field: Field, value: string | number | boolean | undefined, problems: readonly Problem[]): TemplateResult {
  const { name, label } = field;
  const set = (to: string | number | boolean | undefined): void => {
    app.set(item, name, to);
    app.done();
  };
  const id = `field-${name}`;
  switch (field.kind) {
    case 'list':
      return html`<label class="select"><span>${label}</span>
        <select @change=${(event: Event) => set((event.target as HTMLSelectElement).value || undefined)}>
          ${field.isRequired ? nothing : html`<option value="" .selected=${live(value === undefined)}>not stated</option>`}
          ${field.words.map((word) => html`<option value=${word} .selected=${live(word === value)}>${word}</option>`)}
        </select></label>`;
    case 'number':
      return html`<label class="select"><span>${label}</span>
        <select @change=${(event: Event) => set(Number((event.target as HTMLSelectElement).value) || undefined)}>
          <option value="" .selected=${live(value === undefined)}>not stated</option>
          ${field.words.map((word) => html`<option value=${word} .selected=${live(word === value)}>${word}</option>`)}
        </select></label>`;
    case 'choice':
      return html`<label class="check wide"><input type="checkbox" .checked=${live(value === true)} @change=${(event: Event) => set((event.target as HTMLInputElement).checked)} /><span>${label}</span></label>`;
    default: {
      const isWrong = problems.some(({ severity }) => severity === 'error');
      return html`<div class="select ${field.kind === 'gsl' ? 'formal' : 'wide'} ${field.isLong ? 'wide' : ''}">
        <label for=${id}>${label}</label>
        <input
          type="text"
          id=${id}
          autocomplete="off"
          spellcheck=${field.kind === 'gsl' ? 'false' : 'true'}
          placeholder=${field.hint ?? ''}
          aria-invalid=${isWrong ? 'true' : 'false'}
          aria-describedby="${id}-problems"
          .value=${live(String(value ?? ''))}
          @input=${(event: Event) => app.set(item, name, (event.target as HTMLInputElement).value || undefined)}
          @change=${() => app.done()}
        />
        <div id="${id}-problems">${problems.map((problem) => wrong(problem, String(value ?? '')))}</div>
      </div>`;
    }
  }
}

/** Renders a problem of a field, with the wrong part of its text. */
function wrong({ message, hints, severity, range }: Problem, text: string): TemplateResult {
  const bytes = new TextEncoder().encode(text);
  const part = (from: number, to?: number): string => new TextDecoder().decode(bytes.slice(from, to));
  const place =
    range === undefined
      ? nothing
      : html`<code>${part(Math.max(0, range[0] - 12), range[0])}<mark>${part(range[0], range[1]) || '…'}</mark>${part(range[1], range[1] + 12)}</code> `;
  return html`<p class=${severity}>${place}${message}${hints.map((hint) => html` <small>${hint}</small>`)}</p>`;
}
