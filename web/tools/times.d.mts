/** What a check took. */
export interface Timed {
  readonly name: string;
  readonly secs: number;
}
export function shares(text: string): Map<string, number>;
export function slower(checks: readonly Timed[], wanted: ReadonlyMap<string, number>): string[];
