/**
 * Environment of a player in its document. Documents without layout, like those of jsdom and happy-dom, lack parts of it: there a player is never near a
 * window, has no size, and reduced motion is not requested.
 */

/** Distance from the window up to which a player counts as near it. */
const NEAR = '200px';

/** Returns true if the user prefers reduced motion. */
export const reducesMotion = (): boolean => typeof matchMedia === 'function' && matchMedia('(prefers-reduced-motion: reduce)').matches;

/** Observes the size of an element, and its proximity to the window. */
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
