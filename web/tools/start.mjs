// `npm start [-- --port N] [--host NAME]`: prepares everything and serves the page.

import { parseArgs } from 'node:util';
import { main, root, Stop } from './steps.mjs';
import { page } from './setup.mjs';

await main(async () => {
  const { values } = parseArgs({ options: { port: { type: 'string' }, host: { type: 'string' } } });
  const port = values.port === undefined ? undefined : Number(values.port);
  if (port !== undefined && !(Number.isInteger(port) && port >= 0 && port < 65536)) {
    throw new Stop(`--port wants a number from 0 to 65535, not ${values.port}.`);
  }
  await page();
  const { preview } = await import('vite');
  let server;
  try {
    server = await preview({
      root,
      preview: { port: port ?? 4173, strictPort: port !== undefined, host: values.host ?? 'localhost' },
    });
  } catch (error) {
    throw new Stop(`The page cannot be served: ${error.message}.`);
  }
  console.log('\nRaconteur is on stage:');
  server.printUrls();
  console.log('  Press Ctrl+C to stop.\n');
});
