/** Orders by chance that are the same for the same seed, so that a learner who comes back meets what they left. */

/** A seed that nobody knows before, a whole number of 32 bits. */
export function newSeed(): number {
  return crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
}

/** A whole number of 32 bits for a text: FNV-1a, its bits mixed as MurmurHash 3 ends, so that texts that differ in one letter have nothing in common. */
export function hashOf(text: string): number {
  let value = 0x811c9dc5;
  for (const sign of text) value = Math.imul(value ^ (sign.codePointAt(0) ?? 0), 0x01000193);
  value = Math.imul(value ^ (value >>> 16), 0x85ebca6b);
  value = Math.imul(value ^ (value >>> 13), 0xc2b2ae35);
  return (value ^ (value >>> 16)) >>> 0;
}

/** Names in an order by chance; `what` tells one list from another of the same names. */
export function shuffled(names: readonly string[], what: string, seed: number): readonly string[] {
  return [...names].sort((a, b) => hashOf(`${seed} ${what} ${a}`) - hashOf(`${seed} ${what} ${b}`));
}
