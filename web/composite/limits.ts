/** What a session may hold. Whoever works by hand comes to none of these; a file that has more is refused by name. */

export const LIMITS = {
  /** A saved session as text. */
  bytes: 32e6,
  steps: 10_000,
  /** How deep a step is nested, and how many values it has. */
  depth: 8,
  values: 5000,
  letters: 200,
  /** Of one step: of an attribute, of age, of the texture's own detail; and values that are held. */
  amount: 20,
  /** A caricature: 1 changes nothing. */
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
  /** No point of a face is farther from its middle, metres. */
  reach: 1,
} as const;
