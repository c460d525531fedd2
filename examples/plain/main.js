import '@raconteur/player';

const player = document.querySelector('raconteur-player');
const button = document.querySelector('button');
const word = document.querySelector('output');

player?.addEventListener('word', ({ detail }) => {
  if (word) word.value = detail.word.text;
});
button?.addEventListener('click', () => (player?.paused ? player.play() : player?.pause()));
