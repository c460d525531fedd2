/** What the forms of questions say, in the language of the story. */

export interface QuestionWords {
  readonly answer: string;
  readonly notYet: string;
  /** Nothing was answered that could be. */
  readonly first: string;
  readonly choose: string;
  readonly up: (text: string) => string;
  readonly down: (text: string) => string;
  readonly place: (text: string, place: number, of: number) => string;
  readonly gap: (place: number, of: number) => string;
  readonly yourAnswer: string;
  readonly pointing: string;
  readonly fill: string;
  readonly more: string;
  readonly left: (secs: number) => string;
  readonly soon: (secs: number) => string;
  readonly tries: (left: number) => string;
  readonly asks: (prompt: string) => string;
}

const EN: QuestionWords = {
  answer: 'Answer',
  notYet: 'Not yet.',
  first: 'There is no answer yet.',
  choose: 'Choose…',
  up: (text) => `Move up: ${text}`,
  down: (text) => `Move down: ${text}`,
  place: (text, place, of) => `${text}, place ${place} of ${of}`,
  gap: (place, of) => `Gap ${place} of ${of}`,
  yourAnswer: 'Your answer',
  pointing: 'Point at the figure, or choose here.',
  fill: 'Fill the gaps.',
  more: 'More time',
  left: (secs) => `Time left: ${secs} s`,
  soon: (secs) => `${secs} seconds are left.`,
  tries: (left) => (left === 1 ? 'One try is left.' : `${left} tries are left.`),
  asks: (prompt) => `Question: ${prompt}`,
};

const PT: QuestionWords = {
  answer: 'Responder',
  notYet: 'Ainda não.',
  first: 'Ainda não há resposta.',
  choose: 'Escolha…',
  up: (text) => `Para cima: ${text}`,
  down: (text) => `Para baixo: ${text}`,
  place: (text, place, of) => `${text}, lugar ${place} de ${of}`,
  gap: (place, of) => `Espaço ${place} de ${of}`,
  yourAnswer: 'A sua resposta',
  pointing: 'Aponte para a figura, ou escolha aqui.',
  fill: 'Preencha os espaços.',
  more: 'Mais tempo',
  left: (secs) => `Tempo: ${secs} s`,
  soon: (secs) => `Restam ${secs} segundos.`,
  tries: (left) => (left === 1 ? 'Resta uma tentativa.' : `Restam ${left} tentativas.`),
  asks: (prompt) => `Pergunta: ${prompt}`,
};

const DE: QuestionWords = {
  answer: 'Antworten',
  notYet: 'Noch nicht.',
  first: 'Es fehlt noch eine Antwort.',
  choose: 'Bitte wählen…',
  up: (text) => `Nach oben: ${text}`,
  down: (text) => `Nach unten: ${text}`,
  place: (text, place, of) => `${text}, Platz ${place} von ${of}`,
  gap: (place, of) => `Lücke ${place} von ${of}`,
  yourAnswer: 'Ihre Antwort',
  pointing: 'Zeigen Sie auf die Figur, oder wählen Sie hier.',
  fill: 'Füllen Sie die Lücken.',
  more: 'Mehr Zeit',
  left: (secs) => `Noch ${secs} s`,
  soon: (secs) => `Noch ${secs} Sekunden.`,
  tries: (left) => (left === 1 ? 'Ein Versuch bleibt.' : `${left} Versuche bleiben.`),
  asks: (prompt) => `Frage: ${prompt}`,
};

const LANGUAGES: { readonly [language: string]: QuestionWords | undefined } = { en: EN, pt: PT, de: DE };

/** The words of a language, a tag of BCP 47; English where there are none. */
export function wordsOf(language: string): QuestionWords {
  return LANGUAGES[language.toLowerCase().split('-')[0] ?? ''] ?? EN;
}
