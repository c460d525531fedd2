/** "Say it": speaks a sentence of the visitor's own on the stage. */

import { chooseBackends, openInstance } from '../../element/engine/backend.js';
import type { RaconteurPlayer } from '../../element/index.js';
import { INVITATIONS } from '../../speech/words.js';
import { showStage } from './stage.js';
import { Voices } from './voice.js';
import { save } from '../workbench.js';

/** Maximum length of a typed text, characters; enforced by the field. */
const MAX_CHARACTERS = 600;

/** Pattern of a shared text in the address, preceded by its language if that is not English. */
const SHARED = /^#say(?:\.(de|pt))?=(.*)$/s;

/** Returns the address of a text. */
const shared = (text: string, language: string): string => `#say${language === 'en' ? '' : `.${language}`}=${encodeURIComponent(text)}`;

/** Callbacks before a text takes the stage. */
interface SayStage {
  /** Called when the chosen story has left the stage for this script. */
  clear(script: string): void;
}

/** Connects the form to the stage; returns true if the address had a text. */
export function say(player: RaconteurPlayer, { clear }: SayStage): boolean {
  const form = document.querySelector<HTMLFormElement>('#say');
  const field = form?.querySelector('textarea');
  const note = document.querySelector('#say-note');
  const keep = document.querySelector<HTMLButtonElement>('#say-keep');
  const share = document.querySelector<HTMLButtonElement>('#say-share');
  const language = document.querySelector<HTMLSelectElement>('#say-language');
  const better = document.querySelector<HTMLElement>('#say-better');
  if (!form || !field || !note || !keep || !share || !language || !better) return false;
  const voices = new Voices(player, { note, better });
  let script: string | undefined;

  const tell = async (plays: boolean): Promise<void> => {
    const engine = await openInstance(player.backend ?? (await chooseBackends())[0]);
    const next = engine.narrate(field.value, language.value, voices.isSlow(language.value), MAX_CHARACTERS);
    if (next === undefined) {
      note.textContent = 'Write a few words first.';
      field.focus();
      return;
    }
    script = next;
    keep.disabled = share.disabled = false;
    clear(next);
    history.replaceState(null, '', shared(field.value, language.value));
    note.textContent = '';
    await voices.bring(language.value);
    if (plays) showStage(player);
    player.label = 'Your own words';
    player.pause();
    await player.rehearse(next, { roomy: false });
    player.currentTime = 0;
    if (plays) await player.play().catch(() => undefined);
  };

  form.addEventListener('submit', (event) => {
    event.preventDefault();
    void tell(true);
  });
  field.addEventListener('keydown', (event) => {
    if (event.key !== 'Enter' || event.shiftKey || event.isComposing) return;
    event.preventDefault();
    form.requestSubmit();
  });
  language.addEventListener('change', () => {
    field.lang = language.value;
    field.placeholder = INVITATIONS[language.value] ?? '';
    voices.choose(language.value);
  });
  share.addEventListener('click', () => {
    navigator.clipboard.writeText(location.href).then(
      () => (note.textContent = 'The link is copied.'),
      () => (note.textContent = 'The address of this page is the link.'),
    );
  });
  keep.addEventListener('click', async () => {
    if (script === undefined) return;
    keep.disabled = true;
    note.textContent = 'Packing the story…';
    try {
      const { pack } = await import('./keep.js');
      save(await pack(script, player.currentFigure ?? '', language.value), 'my-story.zip');
      note.textContent = 'Script and voice are in my-story.zip: a folder that any page can play.';
    } catch (error) {
      note.textContent = `It could not be saved: ${error instanceof Error ? error.message : String(error)}`;
    }
    keep.disabled = false;
  });

  const [, of = 'en', text] = SHARED.exec(location.hash) ?? [];
  if (text === undefined) return false;
  try {
    field.value = decodeURIComponent(text);
  } catch {
    return false;
  }
  language.value = of;
  field.lang = of;
  void tell(false);
  return true;
}
