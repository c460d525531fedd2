/** What `@raconteur/voice-flite` gives. */

export { flite } from '../../speech/flite.js';
