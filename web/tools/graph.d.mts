export const ENTRIES: Readonly<Record<string, readonly string[]>>;
export const SPECS: string;
export function visits(): Record<string, readonly string[]>;
export function reached(begins: readonly string[]): Set<string>;
export function specsOf(files: readonly string[]): { specs: string[]; unknown: string[] };
export function visitedAt(path: string): string | undefined;
