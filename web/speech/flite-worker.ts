/** Speech worker with flite. */

import { Flite } from './flite-program.js';
import { serve } from './serve.js';

serve('flite', () => Flite.open());
