/**
 * Types of the element in JSX of React 19: `import type {} from '@raconteur/player/react'`. Listeners have the events' names in small
 * letters (`onplay`): React gives `onPlay` to media elements of its own alone, so there is none here. `onPlayCapture` is heard by
 * any element, and so is what bubbles, as `onClick`.
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
