/** Random orders that are reproducible from a seed, so that a returning learner sees the same ones. */

/** Returns an unpredictable seed, a 32-bit integer. */
export function newSeed(): number {
  return crypto.getRandomValues(new Uint32Array(1))[0] ?? 0;
}

/** Returns a 32-bit hash of a text: FNV-1a with the finaliser of MurmurHash 3, so that similar texts have unrelated hashes. */
export function hashOf(text: string): number {
  let value = 0x811c9dc5;
  for (const sign of text) value = Math.imul(value ^ (sign.codePointAt(0) ?? 0), 0x01000193);
  value = Math.imul(value ^ (value >>> 16), 0x85ebca6b);
  value = Math.imul(value ^ (value >>> 13), 0xc2b2ae35);
  return (value ^ (value >>> 16)) >>> 0;
}

/** Shuffles names; `what` distinguishes lists of the same names. */
export function shuffled(names: readonly string[], what: string, seed: number): readonly string[] {
  return [...names].sort((a, b) => hashOf(`${seed} ${what} ${a}`) - hashOf(`${seed} ${what} ${b}`));
}
