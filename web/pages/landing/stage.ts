/** The stage in sight: what is played from below or above it is not played unseen. */

/**
 * Brings the whole stage into the window, its upper edge on top: what grows above it later, a note on who speaks for
 * example, does not push it out again. How it scrolls, the sheet says, which leaps for people who ask for less motion.
 */
export function showStage(player: HTMLElement): void {
  const { top, bottom } = player.getBoundingClientRect();
  if (top < 0 || bottom > innerHeight) player.scrollIntoView({ block: 'start' });
}
