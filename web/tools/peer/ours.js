// The element on a page of its own: `bench.ready`, `bench.speak()`, `bench.state()`.

const player = document.createElement('raconteur-player');
const { quality, backend } = Object.fromEntries(new URLSearchParams(location.search));
const attributes = { id: 'stage', src: '/assets/stories/white-rabbit/story.eml', assets: '/assets/', loading: 'eager', quality, ...(backend && { backend }) };
for (const [name, value] of Object.entries(attributes)) player.setAttribute(name, value);

const ready = new Promise((resolve, reject) => {
  player.addEventListener('canplaythrough', resolve, { once: true });
  player.addEventListener('error', () => reject(new Error(player.error?.message)), { once: true });
});
document.body.append(player);

globalThis.bench = {
  ready,
  speak: () => player.play(),
  state: () => {
    const { quality, triangles, adapter } = player.statistics;
    const { width, height } = player.shadowRoot.querySelector('canvas');
    return { quality, triangles, adapter, width, height };
  },
};
