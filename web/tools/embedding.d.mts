/** Returns the lines of an example's file shown in the guide. */
export function shown(text: string): string[];
/** Returns the guide with the current examples. */
export function written(text: string): string;
/** Returns the guide as stored. */
export function read(): string;
