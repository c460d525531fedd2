import { createServer, type Server } from 'node:http';
import type { AddressInfo } from 'node:net';
import { afterEach, expect, test } from 'vitest';
// @ts-expect-error: an example in plain JavaScript.
import { marySpeech } from '../../examples/mary-speech/server.mjs';

const open: Server[] = [];
const listen = async (server: Server): Promise<string> => {
  open.push(server);
  await new Promise<void>((done) => server.listen(0, '127.0.0.1', done));
  return `http://127.0.0.1:${(server.address() as AddressInfo).port}`;
};
afterEach(() => {
  for (const server of open.splice(0)) server.close();
});

test('the example asks MARY for the sound and the times of a sentence', async () => {
  const asked: URLSearchParams[] = [];
  const mary = await listen(
    createServer(async (request, response) => {
      let body = '';
      for await (const chunk of request) body += chunk;
      const form = new URLSearchParams(body);
      asked.push(form);
      response.end(form.get('OUTPUT_TYPE') === 'AUDIO' ? 'RIFF' : '<maryxml/>');
    }),
  );
  const url = await listen(marySpeech(mary));
  const request = { voice: 'cmu-slt', language: 'en-US', text: 'Fish & <chips>?', words: ['Fish', 'chips'] };
  const response = await fetch(url, { method: 'POST', body: JSON.stringify(request) });
  expect(await response.json()).toEqual({ sound: Buffer.from('RIFF').toString('base64'), times: '<maryxml/>' });
  expect(asked.map((form) => [form.get('LOCALE'), form.get('VOICE')])).toEqual([
    ['en_US', 'cmu-slt'],
    ['en_US', 'cmu-slt'],
  ]);
  expect(asked[0]?.get('INPUT_TEXT')).toContain('Fish &#38; &#60;chips&#62;?');
  // An invalid request is rejected and does not stop the server.
  expect((await fetch(url, { method: 'POST', body: 'no JSON' })).status).toBe(502);
  expect((await fetch(url)).status).toBe(405);
});
