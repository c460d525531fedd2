/** Player for a script tag: `player.ts` with all dependencies, so that a page names one file and needs no bundler. */

export * from './player.js';
