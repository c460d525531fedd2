/** Texts of question forms, in the language of the story. */

export interface QuestionWords {
  readonly answer: string;
  readonly notYet: string;
  /** Message if no answer was entered. */
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
  /** Message after a correct final answer. */
  readonly right: string;
  readonly wrong: string;
  readonly partly: (points: number, of: number) => string;
  readonly rightIs: (answer: string) => string;
  readonly thanks: string;
  readonly over: string;
  readonly atLeast: (number: number) => string;
  readonly atMost: (number: number) => string;
  readonly between: (least: number, most: number) => string;
  readonly close: string;
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
  right: 'That is right.',
  wrong: 'That is not right.',
  partly: (points, of) => `That is partly right: ${points} of ${of} points.`,
  rightIs: (answer) => `Correct answer: ${answer}`,
  thanks: 'Thank you.',
  over: 'Time is up.',
  atLeast: (number) => `at least ${number}`,
  atMost: (number) => `at most ${number}`,
  between: (least, most) => `${least} to ${most}`,
  close: 'Close',
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
  right: 'Está certo.',
  wrong: 'Não está certo.',
  partly: (points, of) => `Está certo em parte: ${points} de ${of} pontos.`,
  rightIs: (answer) => `Resposta certa: ${answer}`,
  thanks: 'Obrigado.',
  over: 'O tempo acabou.',
  atLeast: (number) => `pelo menos ${number}`,
  atMost: (number) => `no máximo ${number}`,
  between: (least, most) => `de ${least} a ${most}`,
  close: 'Fechar',
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
  right: 'Das ist richtig.',
  wrong: 'Das ist nicht richtig.',
  partly: (points, of) => `Das ist zum Teil richtig: ${points} von ${of} Punkten.`,
  rightIs: (answer) => `Richtig ist: ${answer}`,
  thanks: 'Danke.',
  over: 'Die Zeit ist um.',
  atLeast: (number) => `mindestens ${number}`,
  atMost: (number) => `höchstens ${number}`,
  between: (least, most) => `${least} bis ${most}`,
  close: 'Schließen',
};

const LANGUAGES: { readonly [language: string]: QuestionWords | undefined } = { en: EN, pt: PT, de: DE };

/** Returns the texts of a language, a BCP 47 tag; English if it is not available. */
export function wordsOf(language: string): QuestionWords {
  return LANGUAGES[language.toLowerCase().split('-')[0] ?? ''] ?? EN;
}
