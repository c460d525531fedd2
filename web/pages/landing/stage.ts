/** Keeps the stage in view during playback started from above or below it. */

/**
 * Scrolls the whole stage into view, aligned to its top: content that grows above it later, such as a note about the voice, does not push it out. The style
 * sheet sets the scroll behaviour, which is instant for users who prefer reduced motion.
 */
export function showStage(player: HTMLElement): void {
  const { top, bottom } = player.getBoundingClientRect();
  if (top < 0 || bottom > innerHeight) player.scrollIntoView({ block: 'start' });
}
