/** Texts of a course page, in the language of the course. */

import type { Absence } from './report.js';
import type { Trouble } from './storage-problems.js';

export interface CourseWords {
  readonly chapters: string;
  readonly exit: string;
  readonly left: string;
  readonly result: string;
  readonly points: (points: number, most: number) => string;
  readonly passed: string;
  readonly failed: string;
  readonly right: string;
  readonly wrong: string;
  readonly unanswered: string;
  readonly taken: string;
  readonly yours: (answer: string) => string;
  readonly solution: (answer: string) => string;
  readonly again: string;
  readonly review: string;
  readonly saved: string;
  readonly best: (points: number, most: number) => string;
  readonly leaving: string;
  readonly unsaved: string;
  readonly absences: { readonly [why in Absence]: string };
  readonly troubles: { readonly [trouble in Trouble]: string };
}

const EN: CourseWords = {
  chapters: 'Chapters',
  exit: 'Leave the course',
  left: 'You have left the course. You can close this window.',
  result: 'Your result',
  points: (points, most) => `${points} of ${most} points`,
  passed: 'Passed',
  failed: 'Not passed',
  right: 'Right',
  wrong: 'Not right',
  unanswered: 'Not answered',
  taken: 'Answered',
  yours: (answer) => `Your answer: ${answer}`,
  solution: (answer) => `Right: ${answer}`,
  again: 'Try again',
  review: 'Watch again',
  saved: 'Everything is saved.',
  best: (points, most) => `Your best attempt: ${points} of ${most} points`,
  leaving: 'Saving…',
  unsaved: 'Press again to leave anyway.',
  absences: {
    'no-store': 'This course was opened without a record store. Nothing is recorded.',
    'no-learner': 'The address of this course does not name a learner. Nothing is recorded.',
    'no-launch': 'The record store does not specify how to open this course. Nothing is recorded.',
    'not-let-in': 'The system that opened this course refused access: your work is stored in this browser. Open the course there again to have it recorded.',
    'no-system': 'No learning management system was found around this page; nothing is recorded.',
  },
  troubles: {
    away: 'Not saved yet: the system cannot be reached. Your work is stored in this browser, and saved as soon as possible.',
    denied: 'Not saved: the system no longer accepts this course. Your work is stored in this browser; open the course there again.',
    refused: 'Not everything is saved: the system refused part of it. That part is stored in this browser and will be retried.',
    unkept: 'This browser stores nothing here: unsaved work is lost if you close this page.',
  },
};

const PT: CourseWords = {
  chapters: 'Capítulos',
  exit: 'Sair do curso',
  left: 'Saiu do curso. Pode fechar esta janela.',
  result: 'O seu resultado',
  points: (points, most) => `${points} de ${most} pontos`,
  passed: 'Aprovado',
  failed: 'Não aprovado',
  right: 'Certo',
  wrong: 'Não está certo',
  unanswered: 'Sem resposta',
  taken: 'Respondido',
  yours: (answer) => `A sua resposta: ${answer}`,
  solution: (answer) => `Certo: ${answer}`,
  again: 'Tentar outra vez',
  review: 'Ver outra vez',
  saved: 'Está tudo guardado.',
  best: (points, most) => `A sua melhor tentativa: ${points} de ${most} pontos`,
  leaving: 'A guardar…',
  unsaved: 'Carregue outra vez para sair mesmo assim.',
  absences: {
    'no-store': 'Este curso foi aberto sem um sistema de registo. Nada fica registado.',
    'no-learner': 'O endereço deste curso não diz quem aprende. Nada fica registado.',
    'no-launch': 'O sistema de registo não diz como se abre este curso. Nada fica registado.',
    'not-let-in': 'O sistema que abriu este curso não o deixou entrar: o que faz fica neste navegador. Abra lá o curso de novo para ficar registado.',
    'no-system': 'Não há um sistema de aprendizagem à volta desta página; nada fica registado.',
  },
  troubles: {
    away: 'Ainda não guardado: o sistema não responde. O que faz fica neste navegador e é guardado logo que possível.',
    denied: 'Não guardado: o sistema já não aceita este curso. O que faz fica neste navegador; abra lá o curso de novo.',
    refused: 'Nem tudo está guardado: o sistema recusou uma parte. Fica neste navegador e tenta-se outra vez.',
    unkept: 'Este navegador não guarda nada aqui: o que ainda não foi guardado perde-se ao fechar esta página.',
  },
};

const DE: CourseWords = {
  chapters: 'Kapitel',
  exit: 'Kurs verlassen',
  left: 'Sie haben den Kurs verlassen. Sie können dieses Fenster schließen.',
  result: 'Ihr Ergebnis',
  points: (points, most) => `${points} von ${most} Punkten`,
  passed: 'Bestanden',
  failed: 'Nicht bestanden',
  right: 'Richtig',
  wrong: 'Nicht richtig',
  unanswered: 'Nicht beantwortet',
  taken: 'Beantwortet',
  yours: (answer) => `Ihre Antwort: ${answer}`,
  solution: (answer) => `Richtig: ${answer}`,
  again: 'Noch einmal versuchen',
  review: 'Noch einmal ansehen',
  saved: 'Alles ist gespeichert.',
  best: (points, most) => `Ihr bester Versuch: ${points} von ${most} Punkten`,
  leaving: 'Wird gespeichert…',
  unsaved: 'Drücken Sie noch einmal, um trotzdem zu gehen.',
  absences: {
    'no-store': 'Dieser Kurs wurde ohne Aufzeichnung geöffnet. Es wird nichts festgehalten.',
    'no-learner': 'Die Adresse dieses Kurses nennt niemanden, der lernt. Es wird nichts festgehalten.',
    'no-launch': 'Die Aufzeichnung sagt nicht, wie dieser Kurs zu öffnen ist. Es wird nichts festgehalten.',
    'not-let-in': 'Das System, das diesen Kurs geöffnet hat, lässt ihn nicht ein: Was Sie tun, bleibt in diesem Browser. Öffnen Sie den Kurs dort neu, damit es festgehalten wird.',
    'no-system': 'Um diese Seite ist kein Lernsystem; es wird nichts festgehalten.',
  },
  troubles: {
    away: 'Noch nicht gespeichert: Das System ist nicht erreichbar. Was Sie tun, bleibt in diesem Browser und wird gespeichert, sobald es geht.',
    denied: 'Nicht gespeichert: Das System lässt diesen Kurs nicht mehr ein. Was Sie tun, bleibt in diesem Browser; öffnen Sie den Kurs dort neu.',
    refused: 'Nicht alles ist gespeichert: Das System hat einen Teil abgelehnt. Er bleibt in diesem Browser und wird wieder versucht.',
    unkept: 'Dieser Browser behält hier nichts: Was noch nicht gespeichert ist, geht verloren, wenn Sie diese Seite schließen.',
  },
};

const LANGUAGES: { readonly [language: string]: CourseWords | undefined } = { en: EN, pt: PT, de: DE };

/** Returns the texts of a language, a BCP 47 tag; English if there are none. */
export const wordsOf = (language: string): CourseWords => LANGUAGES[language.toLowerCase().split('-')[0] ?? ''] ?? EN;
