/** Statements of xAPI about answers: questions as activities of their own (Data, 2.4.4.1 and appendix C). */

import type { Question } from '../element/base/questions.js';
import type { Reply } from './report.js';
import { identifierOf, patternsOf, responseOf, targetOf, TYPES, type Limits } from './responses.js';
import { contextOf, courseOf, durationOf, scoreOf, VERBS, type Session } from './statements.js';
import type { Statement } from './store.js';
import { plain } from './texts.js';

const INTERACTION = 'http://adlnet.gov/expapi/activities/cmi.interaction';
/** Limits of a statement. The standard has none; but a statement has to be sent while a page closes. */
const LIMITS: Limits = { items: Infinity, gaps: Infinity, gapLength: 250, textLength: 4000, patterns: 100 };
/** Maximum length of the texts of questions and options. */
const MAX_TEXT = 1000;

/** Returns a question's address below that of its course, whose query and fragment stay at the end. */
export function questionId(activityId: string, name: string): string {
  const end = activityId.search(/[?#]/);
  const path = end < 0 ? activityId : activityId.slice(0, end);
  const encoded = encodeURIComponent(name.replaceAll(/\p{Surrogate}/gu, '\uFFFD'));
  return `${path.replace(/\/$/, '')}/questions/${encoded}${end < 0 ? '' : activityId.slice(end)}`;
}

/** Returns the options of a question as the components of its type. */
function componentsOf({ kind, options }: Question, language: string): object {
  const component = (place: number, text: string | undefined) => {
    const id = identifierOf(options[place]?.name ?? '', place);
    return { id, description: { [language]: plain(text ?? '', MAX_TEXT) || id } };
  };
  const all = options.map((option, place) => component(place, option.text || option.picture?.alt));
  switch (TYPES[kind]) {
    case 'choice':
    case 'sequencing':
      return { choices: all };
    case 'matching': {
      const targets = options.flatMap(({ partner }, place) => (partner !== undefined && targetOf(options, place) === place ? [component(place, partner)] : []));
      return { source: all, target: targets };
    }
    default:
      return {};
  }
}

function definitionOf(question: Question, language: string): object {
  const patterns = patternsOf(question, LIMITS);
  const asked = { [language]: plain(question.prompt, MAX_TEXT) || question.kind };
  return {
    type: INTERACTION,
    name: asked,
    description: asked,
    interactionType: TYPES[question.kind],
    ...(patterns.length === 0 ? {} : { correctResponsesPattern: patterns }),
    ...componentsOf(question, language),
  };
}

/** Returns a statement about an answer. */
export function answeredOf(session: Session, reply: Reply): Statement {
  const { question, answered } = reply;
  const response = responseOf(reply, LIMITS);
  return {
    id: crypto.randomUUID(),
    timestamp: new Date(reply.atMs).toISOString(),
    actor: session.actor,
    verb: { id: VERBS.answered, display: { 'en-US': 'answered' } },
    object: { objectType: 'Activity', id: questionId(session.activityId, question.name), definition: definitionOf(question, session.language) },
    result: {
      // An ungraded answer is neither a success nor a failure.
      ...(answered.isRight === undefined ? {} : { success: answered.isRight }),
      ...(response === undefined ? {} : { response }),
      ...scoreOf(answered.points, question.points),
      duration: durationOf(reply.latencyMs),
    },
    // cmi5 allows this statement but does not define it, so it has no cmi5 category.
    context: contextOf(session, { categories: [], parent: courseOf(session), extensions: {} }),
  };
}
