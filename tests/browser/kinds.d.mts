export const SOUND: RegExp;
export const PAGE: RegExp;
export function isPage(spec: string): boolean;
export function isTimed(spec: string): boolean;
