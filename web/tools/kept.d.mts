export function carry(from: string, to: string): number;
export function keptPath(name: string): string;
