/** Types of the element in JSX of Solid: `import type {} from '@raconteur/player/solid'`. Listeners are `on:word`. */

import type { JSX as Solid } from 'solid-js';
import type { PlayerAttributes, PlayerHandlers, RaconteurPlayer } from './attributes.js';

/** Attributes except the events for which Solid has its own types. */
type Common = Omit<Solid.HTMLAttributes<RaconteurPlayer>, keyof PlayerAttributes | keyof PlayerHandlers<'on:'>>;

declare module 'solid-js' {
  namespace JSX {
    interface IntrinsicElements {
      'raconteur-player': Common & PlayerAttributes & PlayerHandlers<'on:'>;
    }
  }
}
