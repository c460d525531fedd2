/** Limits of a session. Manual work never reaches them; a file that exceeds one is rejected with its name. */

export const LIMITS = {
  /** A saved session as text. */
  bytes: 32e6,
  steps: 10_000,
  /** Nesting depth of a step, and its number of values. */
  depth: 8,
  values: 5000,
  letters: 200,
  /** Limits of a step: of an attribute, of age, of the texture's own detail, and of constrained values. */
  amount: 20,
  /** Level of a caricature: 1 changes nothing. */
  level: [0, 4],
  /** A segment along an axis. */
  scale: [0.25, 4],
  /** Radians about an axis. */
  turn: Math.PI,
  /** Metres along an axis. */
  way: 0.1,
  held: 200,
  segments: 100,
  /** The first number that is no seed. */
  seed: 2 ** 32,
  /** Maximum distance of a point of a face from its middle, metres. */
  reach: 1,
} as const;
