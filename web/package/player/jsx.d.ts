/** Types of the element in JSX: `import type {} from '@raconteur/player/jsx'`. */

import type { RaconteurPlayer } from '../../element/element.js';

/** Attributes of `<raconteur-player>` beside those of every element. */
type PlayerAttributes = Partial<
  Pick<
    RaconteurPlayer,
    | 'src'
    | 'figure'
    | 'handedness'
    | 'mind'
    | 'speech'
    | 'assets'
    | 'poster'
    | 'film'
    | 'label'
    | 'backend'
    | 'quality'
    | 'loading'
    | 'controls'
    | 'captions'
    | 'remarks'
    | 'autoplay'
    | 'muted'
    | 'loop'
  >
> & { readonly [attribute: string]: unknown };

declare module 'react' {
  namespace JSX {
    interface IntrinsicElements {
      'raconteur-player': PlayerAttributes;
    }
  }
}

declare module 'solid-js' {
  namespace JSX {
    interface IntrinsicElements {
      'raconteur-player': PlayerAttributes;
    }
  }
}
