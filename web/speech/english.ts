/** Whether a tag of BCP 47 is of English. */
export const isEnglish = (language: string): boolean => /^en\b/i.test(language);
