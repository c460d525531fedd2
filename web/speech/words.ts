/** Placeholders of an empty text box for the user's own words. */
export const INVITATIONS: Record<string, string> = {
  en: 'Hello there! Shall I tell you a secret? :)',
  de: 'Hallo! Soll ich dir ein Geheimnis verraten? :)',
  pt: 'Olá! Queres que te conte um segredo? :)',
};
