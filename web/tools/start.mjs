// `npm start [-- --port N] [--host NAME]`: prepares everything and serves the page.

import { main, root, serverOptions, Stop } from './steps.mjs';
import { page } from './setup.mjs';

await main(async () => {
  const { port, host } = serverOptions('npm start [-- --port N] [--host NAME]');
  await page();
  const { preview } = await import('vite');
  let server;
  try {
    server = await preview({
      root,
      preview: { port: port ?? 4173, strictPort: port !== undefined, host: host ?? 'localhost' },
    });
  } catch (error) {
    throw new Stop(`The page cannot be served: ${error.message}.`);
  }
  console.log('\nRaconteur is on stage:');
  server.printUrls();
  console.log('  Press Ctrl+C to stop.\n');
});
