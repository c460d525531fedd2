/** Duration of a check or a test. */
export interface Timed {
  readonly name: string;
  readonly secs: number;
}
/** Times of a run, and the probe's duration before it. */
export interface Times {
  readonly checks: readonly Timed[];
  readonly tests: readonly Timed[];
  readonly probe: number;
}
export function budgets(text: string): Map<string, number>;
export function referenceProbe(text: string): number;
export function slower(checks: readonly Timed[], wanted: ReadonlyMap<string, number>, pace: number): string[];
export function grown(now: Times, before: Times): string[];
