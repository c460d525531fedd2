/**
 * Returns a value shared by all builds of the player's source in a page: voice packages are built separately and have their own modules, but a page has one
 * library, and permits a trusted-types policy to be created only once.
 */
export function common<T>(name: string, make: () => T): T {
  const page = globalThis as unknown as Record<symbol, T | undefined>;
  return (page[Symbol.for(`raconteur.${name}`)] ??= make());
}
