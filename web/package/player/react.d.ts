/**
 * Types of the element in JSX of React 19: `import type {} from '@raconteur/player/react'`. Listeners have the events' names in small
 * letters (`onplay`): React hears `onPlay` from elements of its own alone.
 */

import type { DetailedHTMLProps, HTMLAttributes } from 'react';
import type { PlayerAttributes, PlayerHandlers, RaconteurPlayer } from './attributes.js';

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'raconteur-player': DetailedHTMLProps<HTMLAttributes<RaconteurPlayer>, RaconteurPlayer> & PlayerAttributes & PlayerHandlers<'on'>;
    }
  }
}
