/** The speech: a line of one's own, or a sentence of a story in its voice. */

import { html, nothing, type TemplateResult } from 'lit';
import { choice } from '../fields.js';
import type { App } from './app.js';
import { lines } from './read.js';
import type { Line, PlanBasis } from './state.js';

const STORIES: Readonly<Record<string, string>> = {
  'white-rabbit': 'The White Rabbit',
  'hello-world': 'Hello World',
  'virtual-poets/jabberwocky': 'Jabberwocky',
  'virtual-poets/zwei-parallelen': 'Die zwei Parallelen',
  'virtual-poets/os-lusiadas': 'Os Lusíadas',
};
const WAYS: Readonly<Record<PlanBasis, string>> = { sound: 'From its audio', text: 'From its text' };
/** Maximum length of the text, characters: about one line. */
const MAX_LETTERS = 300;

/** Sentences of the stories that were fetched, by address. */
const fetched = new Map<string, readonly Line[]>();

const address = (story: string): string => `../assets/stories/${story}/story.eml`;

/** Fetches a story's script; its sentences are offered when it is there. */
async function offer(app: App, story: string, say: (text: string) => void): Promise<void> {
  const src = address(story);
  if (!fetched.has(src)) {
    app.busy = 'Fetching the story…';
    app.redraw();
    try {
      const response = await fetch(src);
      if (!response.ok) throw new Error(`the server answered ${response.status}`);
      fetched.set(src, lines(await response.text()));
    } catch (error) {
      say(`The story could not be fetched: ${error instanceof Error ? error.message : String(error)}.`);
      return;
    } finally {
      app.busy = '';
      app.redraw();
    }
  }
  const [line] = fetched.get(src) ?? [];
  if (line !== undefined) speak(app, src, line);
}

/** Speaks a sentence or text from the beginning. */
export function speak(app: App, src: string, line: Line | string): void {
  app.set((s) => {
    s.story = src;
    s.speech = typeof line === 'string' ? (line === '' ? { kind: 'none' } : { kind: 'text', text: line }) : { kind: 'story', line };
  });
  app.fromStart();
}

/** Renders the form above the strip. */
export function speaking(app: App, say: (text: string) => void): TemplateResult {
  const { speech, story, way } = app.state;
  const mine = speech.kind === 'text' ? speech.text : '';
  const known = fetched.get(story) ?? [];
  const submit = (event: Event): void => {
    event.preventDefault();
    const input = (event.currentTarget as HTMLFormElement).querySelector('input');
    speak(app, '', input?.value.trim().slice(0, MAX_LETTERS) ?? '');
  };
  return html`<form class="line" @submit=${submit}>
      <label class="select"><span>Your own line</span><input type="text" name="line" maxlength=${MAX_LETTERS} .value=${mine} placeholder="Once upon a time, my dear …" autocomplete="off" /></label>
      <button type="submit" class="play">Speak</button>
    </form>
    <label class="select"><span>A story</span>
      <select aria-label="Story" @change=${(event: Event) => void offer(app, (event.target as HTMLSelectElement).value, say)}>
        <option value="" disabled .selected=${story === ''}>Choose one</option>
        ${Object.entries(STORIES).map(([name, title]) => html`<option value=${name} .selected=${story === address(name)}>${title}</option>`)}
      </select></label>
    ${
      known.length === 0
        ? nothing
        : html`<label class="select sentence"><span>Its sentence</span>
          <select aria-label="Sentence" @change=${(event: Event) => {
            const line = known[Number((event.target as HTMLSelectElement).value)];
            if (line !== undefined) speak(app, story, line);
          }}>
            ${known.map((line, i) => html`<option value=${i} .selected=${speech.kind === 'story' && speech.line.markup === line.markup}>${line.label}</option>`)}
          </select></label>`
    }
    ${choice('way', 'Expressions', way, WAYS, (to) => app.set((s) => (s.way = to)))}
    ${speech.kind === 'none' ? nothing : html`<button type="button" class="plain" @click=${() => app.set((s) => Object.assign(s, { speech: { kind: 'none' }, story: '' }))}>Silence</button>`}
    ${app.busy === '' ? nothing : html`<p class="busy"><progress aria-label=${app.busy}></progress>${app.busy}</p>`}`;
}
