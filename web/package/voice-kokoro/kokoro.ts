/** What `@raconteur/voice-kokoro` gives. */

export { kokoro as naturalVoice } from '../../speech/kokoro.js';
