/** Scripts allowed by a page with trusted types: files next to this one. */

import { common } from '../element/base/common.js';
import { placeOf, SCRIPT, spare } from '../element/base/fetching.js';

interface Rules {
  createScriptURL(address: string): string;
}

interface TrustedTypes {
  createPolicy(name: string, rules: Rules): { createScriptURL(address: string): unknown };
}

/** Origins of the files of the player and of voice packages. */
const origins = common('origins', () => new Set<string>());

const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypes };
const rules: Rules = {
  createScriptURL(address) {
    // A worker that imports one is the page's own.
    const own = [...origins, new URL(SCRIPT).origin, spare.library?.origin, globalThis.location?.origin];
    if (!own.includes(new URL(address, SCRIPT).origin)) throw new TypeError('A worker is a file of the player.');
    return address;
  },
};

/** Name of a worker, and the library folder that may contain its file. */
interface WorkerLocation {
  readonly name?: string;
  readonly folder?: string;
}

/** Starts a worker from a file of the player, or of a package of a voice. */
export async function openWorker(address: string, { name = '', folder }: WorkerLocation = {}): Promise<Worker> {
  origins.add(new URL(SCRIPT).origin);
  const policy = common('policy', () => trustedTypes?.createPolicy('raconteur', rules));
  const href = startOf(await placeOf(new URL(address, SCRIPT), folder));
  // The type of worker constructors does not include trusted URLs.
  return new Worker((policy?.createScriptURL(href) ?? href) as string, { type: 'module', name });
}

/** Returns a worker URL: browsers start workers only from the page's own origin; a file of another one is imported by a worker of the page. */
function startOf({ href, origin }: URL): string {
  if (origin === globalThis.location.origin) return href;
  return URL.createObjectURL(new Blob([`import ${JSON.stringify(href)};`], { type: 'text/javascript' }));
}

/** Allows plain URLs of such files inside a worker, for code without support for trusted types. Returns false if the page's policy forbids that. */
export function trustOwnScripts(): boolean {
  try {
    trustedTypes?.createPolicy('default', rules);
    return true;
  } catch {
    return false;
  }
}
