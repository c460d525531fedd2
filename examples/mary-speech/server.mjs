// Lets pages speak with a MARY TTS server: answers the messages of docs/voices.md, “A server”.
//   node examples/mary-speech/server.mjs [http://localhost:59125] [port]

import { createServer } from 'node:http';

const escaped = (text) => text.replace(/[&<>"]/g, (c) => `&#${c.charCodeAt(0)};`);

/** Asks MARY for a text in one form: sound, or XML with the times of all phones. */
async function ask(mary, { voice, language, text }, output) {
  const xml = `<?xml version="1.0" encoding="UTF-8"?><maryxml version="0.5" xmlns="http://mary.dfki.de/2002/MaryXML" xml:lang="${escaped(language)}"><p>${escaped(text)}</p></maryxml>`;
  const body = new URLSearchParams({ INPUT_TYPE: 'RAWMARYXML', INPUT_TEXT: xml, OUTPUT_TYPE: output, LOCALE: language.replace('-', '_'), VOICE: voice, AUDIO: 'WAVE_FILE' });
  const response = await fetch(new URL('/process', mary), { method: 'POST', body });
  if (!response.ok) throw new Error(`MARY answers ${response.status}`);
  return Buffer.from(await response.arrayBuffer());
}

/** Answers one request with the sound and the times of its text. */
async function answer(mary, request) {
  const [sound, times] = await Promise.all([ask(mary, request, 'AUDIO'), ask(mary, request, 'REALISED_ACOUSTPARAMS')]);
  return { sound: sound.toString('base64'), times: times.toString('utf8') };
}

/** A server of such answers. Pages of `origin` may ask it. */
export function marySpeech(mary, origin = 'http://localhost:4173') {
  const headers = { 'Access-Control-Allow-Origin': origin, 'Access-Control-Allow-Headers': 'content-type' };
  return createServer(async (request, response) => {
    try {
      if (request.method !== 'POST') {
        response.writeHead(request.method === 'OPTIONS' ? 204 : 405, headers).end();
        return;
      }
      let body = '';
      for await (const chunk of request.setEncoding('utf8')) {
        body += chunk;
        if (body.length > 100_000) throw new Error('the request is too long');
      }
      const said = await answer(mary, JSON.parse(body));
      response.writeHead(200, { ...headers, 'Content-Type': 'application/json' }).end(JSON.stringify(said));
    } catch (error) {
      response.writeHead(502, headers).end(String(error));
    }
  });
}

if (process.argv[1] === import.meta.filename) {
  const [mary = 'http://localhost:59125', port = '59126'] = process.argv.slice(2);
  marySpeech(mary).listen(Number(port), () => console.log(`Speaks at http://localhost:${port} by the MARY server ${mary}.`));
}
