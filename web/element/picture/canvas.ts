/** Canvases that pictures are drawn on. */

/** One of its own for each try, since a lost canvas keeps its dead context. `lost`: the graphics card has taken its context of WebGL. */
export function newCanvas(lost: () => void): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  canvas.setAttribute('aria-hidden', 'true');
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    lost();
  });
  return canvas;
}

/** What a canvas shows, if it was drawn just now: a canvas forgets its picture when it has gone to the screen. */
export function copyOf(from: HTMLCanvasElement): HTMLCanvasElement | undefined {
  if (from.width === 0 || from.height === 0) return undefined;
  const to = document.createElement('canvas');
  [to.width, to.height] = [from.width, from.height];
  to.getContext('2d')?.drawImage(from, 0, 0);
  return to;
}
