/** The keys of a video player. */

/** Actions of keys. */
export interface KeyActions {
  toggle(): void;
  seekBy(secs: number): void;
  seekToShare(share: number): void;
  volumeBy(step: number): void;
  toggleMuted(): void;
  toggleCaptions(): void;
  toggleFullscreen(): void;
  /** Closes an open panel; returns false if there was none. */
  dismiss(): boolean;
}

/** Seek distance of an arrow key, seconds. */
export const SEEK_STEP_SECS = 5;
const VOLUME_STEP = 0.1;

/** Performs the action of a key; returns true if the key was used. `target` is the innermost focused element. */
export function handleKey(event: KeyboardEvent, target: EventTarget | undefined, actions: KeyActions): boolean {
  if (event.ctrlKey || event.metaKey || event.altKey || event.isComposing) return false;
  const { key } = event;
  // A control that uses a key itself keeps it.
  if (target instanceof HTMLElement) {
    const presses = target.matches('button, summary, a');
    if (presses && (key === ' ' || key === 'Enter')) return false;
    // And so do the controls of a question.
    if (target.matches('select, textarea, [contenteditable], form *') && key !== 'Escape') return false;
    if (target.matches('input.volume') && /^(Arrow|Home|End|Page)/.test(key)) return false;
  }
  switch (key) {
    case ' ':
    case 'k':
    case 'K':
      if (!event.repeat) actions.toggle();
      return true;
    case 'ArrowLeft':
      actions.seekBy(-SEEK_STEP_SECS);
      return true;
    case 'ArrowRight':
      actions.seekBy(SEEK_STEP_SECS);
      return true;
    case 'ArrowUp':
      actions.volumeBy(VOLUME_STEP);
      return true;
    case 'ArrowDown':
      actions.volumeBy(-VOLUME_STEP);
      return true;
    case 'Home':
      actions.seekToShare(0);
      return true;
    case 'End':
      actions.seekToShare(1);
      return true;
    case 'm':
    case 'M':
      actions.toggleMuted();
      return true;
    case 'c':
    case 'C':
      actions.toggleCaptions();
      return true;
    case 'f':
    case 'F':
      actions.toggleFullscreen();
      return true;
    case 'Escape':
      return actions.dismiss();
    default:
      if (/^[0-9]$/.test(key)) {
        actions.seekToShare(Number(key) / 10);
        return true;
      }
      return false;
  }
}
