// Selects the test project of a spec by its name.

/** Tests that measure audio in real time; they run without others on the machine. */
export const SOUND = /(clock|music|play|voice)\.spec/;
export const PAGE = /page\.spec/;

export const isPage = (spec) => PAGE.test(spec);
export const isTimed = (spec) => !isPage(spec) && SOUND.test(spec);
