/** "Say it": a sentence of the visitor's own, told on the stage. */

import type { PlayerEventMap, RaconteurPlayer } from '../element/index.js';
import { told } from '../speech/told.js';

/** Where the address has a text that was shared. */
const SHARED = '#say=';

/** What goes before a text takes the stage. */
interface Stage {
  /** The chosen story has left the stage. */
  clear(): void;
}

/** Hands a file to the visitor. */
function save(file: Blob, name: string): void {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/** Lets the form put texts on the stage; whether the address had one. */
export function say(player: RaconteurPlayer, { clear }: Stage): boolean {
  const form = document.querySelector<HTMLFormElement>('#say');
  const field = form?.querySelector('textarea');
  const note = document.querySelector('#say-note');
  const keep = document.querySelector<HTMLButtonElement>('#say-keep');
  const share = document.querySelector<HTMLButtonElement>('#say-share');
  if (!form || !field || !note || !keep || !share) return false;
  let script: string | undefined;

  const tell = async (plays: boolean): Promise<void> => {
    const next = told(field.value);
    if (next === undefined) {
      note.textContent = 'Write a few words first.';
      field.focus();
      return;
    }
    script = next;
    keep.disabled = share.disabled = false;
    clear();
    history.replaceState(null, '', `${SHARED}${encodeURIComponent(field.value)}`);
    note.textContent = '';
    player.label = 'Your own words';
    player.pause();
    await player.rehearse(next);
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
  player.addEventListener('voiceprogress', (event) => {
    const { share } = (event as PlayerEventMap['voiceprogress']).detail;
    note.textContent = share < 1 ? `A voice is being fetched, once: ${Math.round(100 * share)} %` : 'flite speaks, a small American voice. “raconteur bake” has better ones.';
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
    note.textContent = 'The story is being packed…';
    try {
      const { pack } = await import('./home-keep.js');
      save(await pack(script, player.currentFigure ?? ''), 'my-story.zip');
      note.textContent = 'Script and voice are in my-story.zip: a folder that any page can play.';
    } catch (error) {
      note.textContent = `It could not be kept: ${error instanceof Error ? error.message : String(error)}`;
    }
    keep.disabled = false;
  });

  if (!location.hash.startsWith(SHARED)) return false;
  try {
    field.value = decodeURIComponent(location.hash.slice(SHARED.length));
  } catch {
    return false;
  }
  void tell(false);
  return true;
}
