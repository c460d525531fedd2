/** How much of a story a learner has seen. */

import { common, lengthOf, without, type Span } from '../element/base/ranges.js';

/** The share of a story that was seen, 0 to 1. What of it is `optional`, as answers that nobody has given, does not count. */
export function shareOf(seen: readonly Span[], durationSecs: number, optional: readonly Span[] = []): number {
  if (!(durationSecs > 0) || !Number.isFinite(durationSecs)) return 0;
  const wanted = without(durationSecs, optional);
  const whole = lengthOf(wanted);
  return whole > 0 ? Math.min(1, lengthOf(common(seen, wanted)) / whole) : 0;
}
