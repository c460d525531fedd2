export function placeOf(remote?: string): { repository: { type: string; url: string }; homepage: string; bugs: string } | undefined;
