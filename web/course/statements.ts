/** Statements of the video profile of xAPI (https://w3id.org/xapi/video, version 1.0.3) about a story. */

import type { Score } from '../element/base/answers.js';
import type { Span } from '../element/base/ranges.js';
import type { Statement } from './store.js';

const ADL = 'http://adlnet.gov/expapi/verbs/';
const VIDEO = 'https://w3id.org/xapi/video';
const SESSION = `${VIDEO}/extensions/session-id`;
const CMI5 = 'https://w3id.org/xapi/cmi5/context/';

/** Verbs of a learner's actions, by address. */
export const VERBS = {
  initialized: `${ADL}initialized`,
  completed: `${ADL}completed`,
  terminated: `${ADL}terminated`,
  played: `${VIDEO}/verbs/played`,
  paused: `${VIDEO}/verbs/paused`,
  seeked: `${VIDEO}/verbs/seeked`,
  passed: `${ADL}passed`,
  failed: `${ADL}failed`,
  scored: `${ADL}scored`,
  answered: `${ADL}answered`,
} as const;

/** A verb with the course as object; answers have its questions as object. */
export type Verb = Exclude<keyof typeof VERBS, 'answered'>;

/** Common data of a session's statements. */
export interface Session {
  readonly actor: unknown;
  readonly activityId: string;
  readonly title: string;
  readonly language: string;
  readonly registration: string | undefined;
  /** Identifier of this session if the launch provides none: a UUID. */
  readonly sessionId: string;
  /** The share that counts as all of it, 0 to 1. */
  readonly threshold: number;
  /** True for a cmi5 session, which has rules of its own. */
  readonly isCmi5: boolean;
  /** Share of the points that the system requires, 0 to 1; undefined if it requires none. */
  readonly masteryScore: number | undefined;
}

/** State of the learner when a statement is made. */
export interface LearnerPosition {
  readonly placeSecs: number;
  /** Position before a seek, seconds. */
  readonly fromSecs?: number | undefined;
  readonly durationSecs: number;
  readonly progress: number;
  readonly seen: readonly Span[];
  readonly spentMs: number;
  /** Points up to now; undefined without questions. */
  readonly score: Score | undefined;
  /** True if no question is left to answer: the score is final. */
  readonly isSettled: boolean;
}

const rounded = (secs: number): number => Math.round(secs * 1000) / 1000;
/** Formats a duration in ISO 8601, to hundredths of a second. */
export const durationOf = (ms: number): string => `PT${Math.round(ms / 10) / 100}S`;
/** Formats played spans in the notation of the profile. */
const segments = (seen: readonly Span[]): string => seen.map(([from, to]) => `${rounded(from)}[.]${rounded(to)}`).join('[,]');

/** Returns points as a score; empty if there are none to earn. In cmi5 points are whole (9.5.1), with the exact share, which decides. */
export function scoreOf(points: number, most: number): object {
  if (!(most > 0)) return {};
  const scaled = Math.min(1, Math.max(0, points / most));
  return { score: { scaled, ...(Number.isInteger(points) && Number.isInteger(most) ? { raw: points, min: 0, max: most } : {}) } };
}

/** Returns the results that a verb requires. */
function resultOf(verb: Verb, { isCmi5 }: Session, { placeSecs, fromSecs, progress, seen, spentMs, score, isSettled }: LearnerPosition): object | undefined {
  const extension = (name: string) => `${VIDEO}/extensions/${name}`;
  const points = score === undefined ? {} : scoreOf(score.points, score.most);
  const played = { [extension('progress')]: rounded(progress), [extension('played-segments')]: segments(seen) };
  switch (verb) {
    case 'initialized':
      return undefined;
    case 'played':
      return { extensions: { [extension('time')]: rounded(placeSecs) } };
    case 'seeked':
      return { extensions: { [extension('time-from')]: rounded(fromSecs ?? 0), [extension('time-to')]: rounded(placeSecs) } };
    case 'paused':
      return { extensions: { [extension('time')]: rounded(placeSecs), ...played } };
    case 'completed':
      return {
        completion: true,
        duration: durationOf(spentMs),
        // In cmi5 only statements of passing or failing have a score (9.5.1); an intermediate score
        // would be incomplete.
        ...(isCmi5 || !isSettled ? {} : points),
        extensions: { [extension('time')]: rounded(placeSecs), ...played },
      };
    case 'passed':
    case 'failed':
      return { success: verb === 'passed', duration: durationOf(spentMs), ...points };
    case 'scored':
      return points;
    case 'terminated':
      return { duration: durationOf(spentMs), ...(isCmi5 ? {} : points), extensions: { [extension('time')]: rounded(placeSecs), ...played } };
  }
}

/** Activities of a kind; a single one may stand for a list. */
type Activities = readonly unknown[] | object;

interface Grouped {
  readonly contextActivities?: { readonly [kind: string]: Activities };
  readonly extensions?: object;
}

/** Additions to the context of a session. */
export interface SessionContext {
  readonly categories: readonly string[];
  readonly parent?: object;
  readonly extensions: object;
}

/** Returns the context of a statement, without the launch's additions. */
export function contextOf({ registration, sessionId }: Session, { categories, parent, extensions }: SessionContext): object {
  const category = categories.map((id) => ({ id }));
  return {
    ...(registration === undefined ? {} : { registration }),
    contextActivities: { ...(category.length > 0 ? { category } : {}), ...(parent === undefined ? {} : { parent: [parent] }) },
    extensions: { [SESSION]: sessionId, ...extensions },
  };
}

/** Merges the launch's context template into a statement: no part of it is lost or overwritten (cmi5, 10.2.1). */
export function launchedAs(statement: Statement, template: object): Statement {
  const { contextActivities: own = {}, extensions, ...context } = (statement['context'] ?? {}) as Grouped;
  const { contextActivities: given = {}, extensions: more, ...others } = template as Grouped;
  const kinds = [...new Set([...Object.keys(given), ...Object.keys(own)])];
  const contextActivities = Object.fromEntries(kinds.map((kind) => [kind, [given[kind] ?? [], own[kind] ?? []].flat()]));
  return { ...statement, context: { ...context, ...others, contextActivities, extensions: { ...extensions, ...more } } };
}

/** Returns a statement that an earlier session could not send, as one of this session. */
export function movedTo(statement: Statement, { sessionId }: Session): Statement {
  const { extensions, ...context } = (statement['context'] ?? {}) as Grouped;
  return { ...statement, context: { ...context, extensions: { ...extensions, [SESSION]: sessionId } } };
}

/** Returns true if a statement has one of these verbs. */
export const hasVerb = ({ verb }: Statement, ...verbs: readonly Verb[]): boolean => verbs.some((it) => VERBS[it] === (verb as { id?: unknown } | undefined)?.id);

/** Returns the course as an activity. */
export const courseOf = ({ activityId, language, title }: Session): object => ({
  objectType: 'Activity',
  id: activityId,
  definition: { type: `${VIDEO}/activity-type/video`, name: { [language]: title } },
});

/** Returns the categories of a statement about the course: the profile's, and cmi5's for its own statements (9.6.2), which permits others. */
function categoriesOf(verb: Verb, isCmi5: boolean): string[] {
  const isJudged = verb === 'passed' || verb === 'failed';
  const isOwn = isJudged || verb === 'completed' || verb === 'initialized' || verb === 'terminated';
  const own = [...(isOwn ? ['cmi5'] : []), ...(isJudged || verb === 'completed' ? ['moveon'] : [])];
  return [...(isJudged || verb === 'scored' ? [] : [VIDEO]), ...(isCmi5 ? own.map((name) => `${CMI5}categories/${name}`) : [])];
}

/** Returns a new statement about the course, with the current time. */
export function statementOf(verb: Verb, session: Session, moment: LearnerPosition): Statement {
  const result = resultOf(verb, session, moment);
  const { isCmi5, masteryScore, threshold } = session;
  const isJudged = verb === 'passed' || verb === 'failed';
  const extensions = {
    [`${VIDEO}/extensions/length`]: rounded(moment.durationSecs),
    [`${VIDEO}/extensions/completion-threshold`]: String(threshold),
    ...(isJudged && masteryScore !== undefined ? { [`${CMI5}extensions/masteryscore`]: masteryScore } : {}),
  };
  return {
    id: crypto.randomUUID(),
    timestamp: new Date().toISOString(),
    actor: session.actor,
    verb: { id: VERBS[verb], display: { 'en-US': verb } },
    object: courseOf(session),
    ...(result === undefined ? {} : { result }),
    context: contextOf(session, { categories: categoriesOf(verb, isCmi5), extensions }),
  };
}
