/** Selection of the pool items performed for a learner, and the spans skipped with the others. */

import { shuffled } from './chance.js';
import type { Question, FlowEntry } from '../base/questions.js';

/** Returns the orders of items not drawn, and of all their contents. */
export function leftOut(questions: readonly Question[], ways: readonly FlowEntry[], seed: number): ReadonlySet<number> {
  const items = new Map<number, number[]>();
  for (const way of ways) if (way.kind === 'item') items.set(way.pool, [...(items.get(way.pool) ?? []), way.order]);
  const out = new Set<number>();
  // Pools are identified by number, because positions change with the preceding text.
  [...ways].filter(isPool).forEach(({ order, count }, nth) => {
    const all = items.get(order) ?? [];
    const numbers = all.map((_, i) => String(i));
    for (const i of shuffled(numbers, `pool ${nth}`, seed).slice(count)) out.add(all[Number(i)] ?? -1);
  });
  if (out.size === 0) return out;
  // Items inside an element come after it.
  const inside: readonly (FlowEntry | Question)[] = [...ways, ...questions].sort((a, b) => a.order - b.order);
  for (const it of inside) {
    if (!out.has(it.order) && !(it.within !== undefined && out.has(it.within))) continue;
    out.add(it.order);
    if ('answers' in it) for (const { order } of it.answers) out.add(order);
  }
  return out;
}

const isPool = (way: FlowEntry): way is FlowEntry & { readonly kind: 'pool' } => way.kind === 'pool';
