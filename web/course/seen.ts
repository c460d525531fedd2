/** Share of a story that a learner has seen. */

import { common, lengthOf, without, type Span } from '../element/base/ranges.js';

/** Returns the share of a story that was seen, 0 to 1. `optional` spans, such as reactions to answers not given, do not count. */
export function shareOf(seen: readonly Span[], durationSecs: number, optional: readonly Span[] = []): number {
  if (!(durationSecs > 0) || !Number.isFinite(durationSecs)) return 0;
  const wanted = without(durationSecs, optional);
  const whole = lengthOf(wanted);
  return whole > 0 ? Math.min(1, lengthOf(common(seen, wanted)) / whole) : 0;
}
