/** Statements of the video profile of xAPI (https://w3id.org/xapi/video, version 1.0.3) about a story. */

import type { Span } from '../element/ranges.js';
import type { Statement } from './outbox.js';

const ADL = 'http://adlnet.gov/expapi/verbs/';
const VIDEO = 'https://w3id.org/xapi/video';

/** What a learner does, by the verbs' addresses. */
export const VERBS = {
  initialized: `${ADL}initialized`,
  completed: `${ADL}completed`,
  terminated: `${ADL}terminated`,
  played: `${VIDEO}/verbs/played`,
  paused: `${VIDEO}/verbs/paused`,
  seeked: `${VIDEO}/verbs/seeked`,
} as const;

export type Verb = keyof typeof VERBS;

/** What statements of a session have in common. */
export interface Session {
  readonly actor: unknown;
  readonly activityId: string;
  readonly title: string;
  readonly language: string;
  readonly registration: string | undefined;
  /** What all statements of the launch are to have in their contexts. */
  readonly context: { readonly [part: string]: unknown };
  /** Of this session, where the launch gives none: a UUID. */
  readonly sessionId: string;
  /** The share that counts as all of it, 0 to 1. */
  readonly threshold: number;
}

/** Where the learner is as a statement is made. */
export interface Moment {
  readonly placeSecs: number;
  /** Before a seek. */
  readonly fromSecs?: number | undefined;
  readonly durationSecs: number;
  readonly progress: number;
  readonly seen: readonly Span[];
  readonly spentMs: number;
}

const rounded = (secs: number): number => Math.round(secs * 1000) / 1000;
/** ISO 8601, hundredths of a second. */
export const durationOf = (ms: number): string => `PT${Math.round(ms / 10) / 100}S`;
/** As the profile writes what was played. */
const segments = (seen: readonly Span[]): string => seen.map(([from, to]) => `${rounded(from)}[.]${rounded(to)}`).join('[,]');

/** Extensions of the result that a verb asks for. */
function resultOf(verb: Verb, { placeSecs, fromSecs, progress, seen, spentMs }: Moment): object | undefined {
  const extension = (name: string) => `${VIDEO}/extensions/${name}`;
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
      return { completion: true, duration: durationOf(spentMs), extensions: { [extension('time')]: rounded(placeSecs), ...played } };
    case 'terminated':
      return { duration: durationOf(spentMs), extensions: { [extension('time')]: rounded(placeSecs), ...played } };
  }
}

interface Grouped {
  readonly contextActivities?: { readonly category?: readonly unknown[] };
  readonly extensions?: object;
}

/** A statement that is made now. `categories` are added to that of the profile. */
export function statementOf(verb: Verb, session: Session, moment: Moment, categories: readonly string[] = []): Statement {
  const { contextActivities, extensions, ...context } = session.context as Grouped;
  const result = resultOf(verb, moment);
  return {
    id: crypto.randomUUID(),
    timestamp: new Date().toISOString(),
    actor: session.actor,
    verb: { id: VERBS[verb], display: { 'en-US': verb } },
    object: { objectType: 'Activity', id: session.activityId, definition: { type: `${VIDEO}/activity-type/video`, name: { [session.language]: session.title } } },
    ...(result === undefined ? {} : { result }),
    context: {
      ...context,
      ...(session.registration === undefined ? {} : { registration: session.registration }),
      contextActivities: { ...contextActivities, category: [...(contextActivities?.category ?? []), ...[VIDEO, ...categories].map((id) => ({ id }))] },
      extensions: {
        [`${VIDEO}/extensions/session-id`]: session.sessionId,
        [`${VIDEO}/extensions/length`]: rounded(moment.durationSecs),
        [`${VIDEO}/extensions/completion-threshold`]: String(session.threshold),
        ...extensions,
      },
    },
  };
}
