/** What a box for one's own words says before anything is written there. */
export const INVITATIONS: Record<string, string> = {
  en: 'Hello there! Shall I tell you a secret? :)',
  de: 'Hallo! Soll ich dir ein Geheimnis verraten? :)',
  pt: 'Olá! Queres que te conte um segredo? :)',
};
