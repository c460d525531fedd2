/** Types of the element in Svelte 5: `import type {} from '@raconteur/player/svelte'`. Listeners are `onword`. */

import type { HTMLAttributes } from 'svelte/elements';
import type { PlayerAttributes, PlayerHandlers, RaconteurPlayer } from './attributes.js';

/** Attributes except the events for which Svelte has its own types. */
type Common = Omit<HTMLAttributes<RaconteurPlayer>, keyof PlayerAttributes | keyof PlayerHandlers<'on'>>;

declare module 'svelte/elements' {
  interface SvelteHTMLElements {
    'raconteur-player': Common & PlayerAttributes & PlayerHandlers<'on'>;
  }
}
