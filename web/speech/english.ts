/** Returns true if a BCP 47 tag is English. */
export const isEnglish = (language: string): boolean => /^en\b/i.test(language);
