/**
 * What the document around a player tells it. Documents without a layout, as jsdom's and happy-dom's are, lack some of that: there
 * a player is never near a window and has no size, and nobody has asked for less motion.
 */

/** So far from the window a player counts as near it. */
const NEAR = '200px';

/** Whether people have asked for less motion. */
export const reducesMotion = (): boolean => typeof matchMedia === 'function' && matchMedia('(prefers-reduced-motion: reduce)').matches;

/** Watches the size of an element, and whether it is near the window. */
export class Surroundings {
  readonly #sizes: ResizeObserver | undefined;
  readonly #sights: IntersectionObserver | undefined;

  constructor(resized: () => void, appeared: (isNear: boolean) => void) {
    if (typeof ResizeObserver === 'function') this.#sizes = new ResizeObserver(resized);
    if (typeof IntersectionObserver === 'function') {
      this.#sights = new IntersectionObserver((entries) => appeared(entries.at(-1)?.isIntersecting ?? false), { rootMargin: NEAR });
    }
  }

  watch(element: Element): void {
    this.#sizes?.observe(element);
    this.#sights?.observe(element);
  }

  rest(): void {
    this.#sizes?.disconnect();
    this.#sights?.disconnect();
  }
}
