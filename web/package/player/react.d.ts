/**
 * Types of the element in JSX of React 19: `import type {} from '@raconteur/player/react'`. Listeners use the event names in lower case (`onplay`): React
 * supports `onPlay` only on native media elements, so it is omitted here. `onPlayCapture` works on any element, as do bubbling events such as `onClick`.
 */

import type { ClassAttributes, HTMLAttributes } from 'react';
import type { PlayerAttributes, PlayerHandlers, RaconteurPlayer } from './attributes.js';

type Common = HTMLAttributes<RaconteurPlayer>;

/** React's names of listeners for the player's own events, which it would not attach. */
type Unheard = { [Name in keyof Common]-?: Lowercase<Name> extends keyof PlayerHandlers<'on'> ? Name : never }[keyof Common];

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'raconteur-player': ClassAttributes<RaconteurPlayer> & Omit<Common, Unheard> & PlayerAttributes & PlayerHandlers<'on'>;
    }
  }
}
