/** Launch of a course with a record store: by a link, like Tin Can packages, or by a cmi5 system (cmi5, 8 and 10). */

import { until } from './retry-timer.js';
import { RecordError } from './report.js';
import { RecordStore, type Access, type Outcome, type Owner } from './store.js';
import type { StorageProblem } from './storage-problems.js';

/** Data from the page's address. */
export interface Link {
  readonly endpoint: string;
  /** Address from which a cmi5 system returns the token, once; undefined without cmi5. */
  readonly fetch: string | undefined;
  readonly auth: string;
  readonly actor: unknown;
  readonly owner: Owner;
}

/** Launch data of a cmi5 system (10.2); empty without cmi5. */
export interface Launch {
  readonly access: Access;
  /** Template for the contexts of all statements. */
  readonly template: object;
  /** True if the course is only reviewed: no actions are reported. */
  readonly isReview: boolean;
  /** The share of the points that the system wants, 0 to 1. */
  readonly masteryScore: number | undefined;
  readonly returnAddress: string | undefined;
  /** True if the preferences of the learner turn audio off in every course (11). */
  readonly isMuted: boolean;
}

/** Reads the page's address. Throws a `RecordError` if it names no store: the course was not launched. */
export function linkOf(address: string, courseId: string): Link {
  const asked = new URL(address).searchParams;
  const [endpoint, actor, fetch] = ['endpoint', 'actor', 'fetch'].map((name) => asked.get(name));
  if (endpoint == null || actor == null) throw new RecordError('no-store', 'The address of the page does not name a record store.');
  const activityId = asked.get('activityId') ?? asked.get('activity_id') ?? courseId;
  return {
    endpoint: endpoint.endsWith('/') ? endpoint : `${endpoint}/`,
    fetch: fetch ?? undefined,
    auth: asked.get('auth') ?? '',
    actor: parsed(actor),
    owner: { activityId, agent: actor, registration: asked.get('registration') ?? undefined },
  };
}

function parsed(json: string): unknown {
  try {
    return JSON.parse(json) as unknown;
  } catch {
    throw new RecordError('no-learner', 'The address of the page does not name a learner.');
  }
}

function launchIn(text: string): unknown {
  try {
    return JSON.parse(text) as unknown;
  } catch {
    return undefined;
  }
}

interface Waiting {
  readonly trouble: (what: string, trouble: StorageProblem | undefined) => void;
  readonly isClosed: () => boolean;
}

/** Requests a text from the store until it answers; returns undefined if the page closed before. */
export function textOf(ask: () => Promise<{ readonly outcome: Outcome; readonly text: string }>, { trouble, isClosed }: Waiting): Promise<string | undefined> {
  return until(async () => {
    const { outcome, text } = await ask();
    trouble('opening', outcome === 'taken' ? undefined : outcome);
    return outcome === 'taken' ? text : undefined;
  }, isClosed);
}

/** Requests the token of a session: the system returns it once (8.2), so only failed requests are repeated. */
function tokenOf(address: string, { trouble, isClosed }: Waiting): Promise<string | undefined> {
  return until(async () => {
    const response = await fetch(address, { method: 'POST' }).catch(() => undefined);
    const isAway = response === undefined || response.status >= 500;
    trouble('opening', isAway ? 'away' : undefined);
    if (isAway) return undefined;
    const answer = (await response.json().catch(() => undefined)) as { 'auth-token'?: unknown } | undefined;
    const token = response.ok ? answer?.['auth-token'] : undefined;
    if (typeof token === 'string') return token;
    throw new RecordError('not-let-in', 'The system gave no token.');
  }, isClosed);
}

const isShare = (value: unknown): value is number => typeof value === 'number' && value >= 0 && value <= 1;

/** Returns an address to which a page may go. */
function addressIn(value: unknown): string | undefined {
  if (typeof value !== 'string' || !URL.canParse(value)) return undefined;
  return ['https:', 'http:'].includes(new URL(value).protocol) ? value : undefined;
}

/** Returns the launch data of the system; undefined if the page closed before it answered. */
export async function launchOf(link: Link, waiting: Waiting): Promise<Launch | undefined> {
  const plain = { template: {}, isReview: false, masteryScore: undefined, returnAddress: undefined, isMuted: false };
  if (link.fetch === undefined) return { ...plain, access: { endpoint: link.endpoint, authorization: link.auth } };
  const token = await tokenOf(link.fetch, waiting);
  if (token === undefined) return undefined;
  const access = { endpoint: link.endpoint, authorization: `Basic ${token}` };
  const store = new RecordStore(access);
  const text = await textOf(() => store.state(link.owner, 'LMS.LaunchData'), waiting);
  if (text === undefined) return undefined;
  const data = launchIn(text);
  if (typeof data !== 'object' || data === null) throw new RecordError('no-launch', 'The record store has no launch data.');
  const { contextTemplate, launchMode = 'Normal', masteryScore, returnURL } = data as { [name: string]: unknown };
  return {
    access,
    template: typeof contextTemplate === 'object' && contextTemplate !== null ? contextTemplate : {},
    isReview: launchMode !== 'Normal',
    masteryScore: isShare(masteryScore) ? masteryScore : undefined,
    returnAddress: addressIn(returnURL),
    isMuted: await wantsSilence(store, link.owner, waiting),
  };
}

/** Returns true if the learner's preferences (11.2) turn audio off: a story has one language, but it can be silent. */
async function wantsSilence(store: RecordStore, owner: Owner, { isClosed }: Waiting): Promise<boolean> {
  // Preferences are optional: the page does not wait if the system has none.
  const { text } = isClosed() ? { text: '' } : await store.profile(owner, 'cmi5LearnerPreferences');
  try {
    return (JSON.parse(text || '{}') as { audioPreference?: unknown } | null)?.audioPreference === 'off';
  } catch {
    return false;
  }
}
