/** Returns the lines of an example's file shown in the guide. */
export function shown(text: string): string[];
/** The guide with the examples as they are now. */
export function written(text: string): string;
/** The guide as it is. */
export function read(): string;
