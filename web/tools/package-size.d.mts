export function printSizes(folder: string, packages: readonly string[]): void;
export function checkContents(contents: ReadonlySet<string>): void;
export function checkSize(own: string): void;
