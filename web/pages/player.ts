/** Registers `<raconteur-player>` for the pages, which specify the location of the library themselves. */

import { register } from '../element/register.js';

register();
