/** Types of the element in templates of Vue 3: `import type {} from '@raconteur/player/vue'`. Listeners are `@word`. */

import type { HTMLAttributes, PublicProps } from 'vue';
import type { PlayerAttributes, PlayerEvents } from './attributes.js';

/** Listeners by the names that Vue's compiler uses. */
type Handlers = {
  [Name in keyof PlayerEvents as `on${Capitalize<Name>}`]?: ((event: PlayerEvents[Name]) => unknown) | undefined;
};

/** Attributes except the events for which Vue has its own types. */
type Common = Omit<HTMLAttributes, keyof PlayerAttributes | keyof Handlers>;

declare module 'vue' {
  interface GlobalComponents {
    'raconteur-player': new () => { $props: PublicProps & Common & PlayerAttributes & Handlers };
  }
}
