/** An image in front of a plain wall, derived from two images of the same face in different sets, whose differences mark the background. */

/** The wall: linear greys of passports are about as bright. */
export const WALL = 205;
/** Maximum difference of a figure pixel between two sets, caused by reflected light and noise, of 255. */
const SAME = 6;

/** Returns the mask of the figure: pixels that are equal in both images and connected with the centre. */
export function figureOf(a: Uint8ClampedArray, b: Uint8ClampedArray, width: number, height: number): Uint8Array {
  const isLike = (i: number): boolean => [0, 1, 2].every((c) => Math.abs((a[4 * i + c] ?? 0) - (b[4 * i + c] ?? 0)) <= SAME);
  const like = Uint8Array.from({ length: width * height }, (_, i) => Number(isLike(i)));
  const middle = Math.floor(height / 2) * width + Math.floor(width / 2);
  const figure = reached(like, width, height, 1, [middle]);
  // Areas inside the border belong to the head: eyes reflect the stage.
  const border = Array.from({ length: figure.length }, (_, i) => i).filter((i) => i < width || i >= figure.length - width || i % width === 0 || i % width === width - 1);
  const around = reached(figure, width, height, 0, border);
  return around.map((out) => 1 - out);
}

/** Returns a mask of the pixels with a value that are connected to given pixels. */
function reached(values: Uint8Array, width: number, height: number, value: number, from: readonly number[]): Uint8Array {
  const found = new Uint8Array(values.length);
  const stack = from.filter((i) => values[i] === value);
  for (const i of stack) found[i] = 1;
  for (let i = stack.pop(); i !== undefined; i = stack.pop()) {
    const [x, y] = [i % width, Math.floor(i / width)];
    const beside = [x > 0 ? i - 1 : -1, x < width - 1 ? i + 1 : -1, y > 0 ? i - width : -1, y < height - 1 ? i + width : -1];
    for (const next of beside) {
      if (next < 0 || found[next] === 1 || values[next] !== value) continue;
      found[next] = 1;
      stack.push(next);
    }
  }
  return found;
}

/** Returns the first of two images in front of the wall; its edges are one pixel soft. */
export function beforeWall(one: HTMLCanvasElement, other: HTMLCanvasElement): HTMLCanvasElement {
  const { width, height } = one;
  const context = one.getContext('2d');
  const picture = context?.getImageData(0, 0, width, height);
  const second = other.getContext('2d')?.getImageData(0, 0, width, height);
  if (context === undefined || context === null || picture === undefined || second === undefined) throw new Error('There is no picture of the face.');
  const figure = figureOf(picture.data, second.data, width, height);
  for (let i = 0; i < figure.length; i += 1) {
    const around = [i, i - 1, i + 1, i - width, i + width].map((at) => figure[at] ?? figure[i] ?? 0);
    const share = around.reduce((sum, is) => sum + is, 0) / around.length;
    for (let c = 4 * i; c < 4 * i + 3; c += 1) picture.data[c] = share * (picture.data[c] ?? 0) + (1 - share) * WALL;
  }
  context.putImageData(picture, 0, 0);
  return one;
}
