/** Entry point of `@raconteur/voice-kokoro`. */

export { kokoro as naturalVoice } from '../../speech/kokoro.js';
