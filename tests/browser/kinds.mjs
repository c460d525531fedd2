// Which project a spec belongs to, by its name.

/** What is measured against sound as it is played; these have the machine for themselves. */
export const SOUND = /(clock|music|play|voice)\.spec/;
export const PAGE = /page\.spec/;

export const isPage = (spec) => PAGE.test(spec);
export const isTimed = (spec) => !isPage(spec) && SOUND.test(spec);
