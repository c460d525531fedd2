/** Canvases for rendering. */

/** Creates a canvas for each attempt, because a lost canvas keeps its dead context. `lost`: its WebGL context was lost. */
export function newCanvas(lost: () => void): HTMLCanvasElement {
  const canvas = document.createElement('canvas');
  canvas.setAttribute('aria-hidden', 'true');
  canvas.addEventListener('webglcontextlost', (event) => {
    event.preventDefault();
    lost();
  });
  return canvas;
}

/** Returns a copy of a canvas just rendered: a canvas loses its image after presentation. */
export function copyOf(from: HTMLCanvasElement): HTMLCanvasElement | undefined {
  if (from.width === 0 || from.height === 0) return undefined;
  const to = document.createElement('canvas');
  [to.width, to.height] = [from.width, from.height];
  to.getContext('2d')?.drawImage(from, 0, 0);
  return to;
}
