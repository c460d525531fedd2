/** Registers `<raconteur-player>` for the pages, which say themselves where the library is. */

import { register } from '../element/register.js';

register();
