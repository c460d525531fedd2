// TalkingHead on a page of its own, speaking the first sentences of the same story with the same sound:
// `bench.ready`, `bench.speak()`, `bench.state()`.

import { TalkingHead } from '/peer/node_modules/@met4citizen/talkinghead/modules/talkinghead.mjs';

const STORY = '/assets/stories/white-rabbit/voice/';
/** Enough for the time that is measured. */
const SENTENCES = 4;

const stage = document.createElement('div');
stage.id = 'stage';
document.body.append(stage);

const head = new TalkingHead(stage, {
  ttsEndpoint: '/none', ttsApikey: 'none', lipsyncModules: ['en'], cameraView: 'upper', modelPixelRatio: 1, modelFPS: 60,
});

/** The words of an utterance of a speech bundle with their times, milliseconds. */
function words({ text, words: rows, msecs }) {
  const bytes = new TextEncoder().encode(text);
  const starts = [0];
  for (const length of msecs) starts.push(starts.at(-1) + length);
  const heard = rows.map(([byte, length, phone, phones]) => ({
    word: new TextDecoder().decode(bytes.subarray(byte, byte + length)), start: starts[phone], end: starts[phone + phones],
  }));
  return { words: heard.map((w) => w.word), wtimes: heard.map((w) => w.start), wdurations: heard.map((w) => w.end - w.start) };
}

async function load() {
  await head.showAvatar({ url: '/peer/avatar.glb', body: 'F', avatarMood: 'neutral', lipsyncLang: 'en' });
  const { utterances } = await (await fetch(`${STORY}speech.json`)).json();
  return Promise.all(utterances.slice(0, SENTENCES).map(async (utterance) => {
    const sound = await (await fetch(STORY + utterance.audio[0].file)).arrayBuffer();
    return { audio: await head.audioCtx.decodeAudioData(sound), ...words(utterance) };
  }));
}

const sentences = load();
globalThis.bench = {
  ready: sentences.then(() => new Promise(requestAnimationFrame)),
  speak: async () => {
    for (const sentence of await sentences) head.speakAudio(sentence);
  },
  state: () => {
    const { width, height } = head.renderer.domElement;
    return { triangles: head.renderer.info.render.triangles, width, height };
  },
};
