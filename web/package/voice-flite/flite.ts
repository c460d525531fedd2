/** Entry point of `@raconteur/voice-flite`. */

export { flite } from '../../speech/flite.js';
