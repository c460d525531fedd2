/** Crates by name: their folders, and the packages they use. */
export type Crates = ReadonlyMap<string, { readonly folder: string; readonly uses: readonly string[] }>;
export function affected(files: readonly string[], crates: Crates): string[];
export function needed(): { checks: string[]; crates: string[]; specs: string[] };
export function sources(name: string, crates?: Crates): string[];
