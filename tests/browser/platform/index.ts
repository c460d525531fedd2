/** All themes of the platform tests. */

import { theme as cues } from './cues.js';
import { theme as interfaces } from './interface.js';
import { theme as loading } from './loading.js';
import { theme as picture } from './picture.js';
import { theme as places } from './places.js';
import { theme as playing } from './playing.js';
import type { Theme } from './rows.js';
import { theme as seeking } from './seeking.js';
import { theme as sound } from './sound.js';
import { theme as standard } from './standard.js';
import { theme as tracks } from './tracks.js';

export const themes: readonly Theme[] = [interfaces, loading, playing, places, seeking, standard, sound, tracks, cues, picture];
