/**
 * What all builds of the player's source have in common in a page: packages of voices are built apart from the player and have
 * modules of their own, but a page has one library, and lets a policy of trusted types be made once.
 */
export function common<T>(name: string, make: () => T): T {
  const page = globalThis as unknown as Record<symbol, T | undefined>;
  return (page[Symbol.for(`raconteur.${name}`)] ??= make());
}
