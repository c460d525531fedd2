/** What a page with trusted types lets become a script: files beside this one. */

interface Rules {
  createScriptURL(address: string): string;
}

interface TrustedTypes {
  createPolicy(name: string, rules: Rules): { createScriptURL(address: string): unknown };
}

const { trustedTypes } = globalThis as { trustedTypes?: TrustedTypes };
const rules: Rules = {
  createScriptURL(address) {
    if (new URL(address, import.meta.url).origin !== new URL(import.meta.url).origin) throw new TypeError('A worker is a file of the player.');
    return address;
  },
};

let policy: ReturnType<TrustedTypes['createPolicy']> | undefined;

/** Starts a worker from a file of the player. */
export function openWorker(address: string, name = ''): Worker {
  policy ??= trustedTypes?.createPolicy('raconteur', rules);
  const { href } = new URL(address, import.meta.url);
  // The type of workers' constructors does not know trusted addresses.
  return new Worker((policy?.createScriptURL(href) ?? href) as string, { type: 'module', name });
}

/** Within a worker: has plain addresses of such files trusted, for code that knows no trusted types. False where the page's policy does not allow that. */
export function trustOwnScripts(): boolean {
  try {
    trustedTypes?.createPolicy('default', rules);
    return true;
  } catch {
    return false;
  }
}
