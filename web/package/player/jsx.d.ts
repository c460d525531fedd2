/** Types of the element in JSX of React and of Solid: `import type {} from '@raconteur/player/jsx'`. */

import type {} from './react.js';
import type {} from './solid.js';
