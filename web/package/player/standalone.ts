/** The player for a script tag: as `player.ts`, with all that it needs, so that a page names one file and needs no bundler. */

export * from './player.js';
