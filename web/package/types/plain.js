// Mistakes that types must see.

const player = document.querySelector('raconteur-player');

player?.addEventListener('word', ({ detail }) => {
  /** @type {string} */
  const text = detail.word.text;
  // @ts-expect-error: a word has no such member.
  return `${text}${detail.word.wrong}`;
});
// @ts-expect-error: a flag is no number.
if (player) player.controls = 3;
