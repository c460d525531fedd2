/** A record store for tests, and how a course with one is launched. */

import { vi } from 'vitest';
import { NOTHING, type Memory } from '../course/memory.js';
import type { Report } from '../course/report.js';
import type { Shelf } from '../course/shelf.js';
import { VERBS } from '../course/statements.js';

/** Record store that accepts what the standard allows, and can be unavailable. */
export class FakeStore {
  readonly statements: { id: string; verb: { id: string }; timestamp: string; [part: string]: unknown }[] = [];
  readonly states = new Map<string, string>();
  readonly profiles = new Map<string, string>();
  isAway = false;
  /** True if responses to accepted requests are lost. */
  losesAnswers = false;
  tokens = 0;
  readonly faults: string[] = [];
  /** Alternative status, if defined: for statements also by their ids. */
  status: (method: string, resource: string, ids: readonly string[]) => number | undefined = () => undefined;

  readonly fetch = async (address: string | URL, { method = 'GET', headers = {}, body }: RequestInit = {}): Promise<Response> => {
    await Promise.resolve();
    const { pathname, searchParams, href } = new URL(address);
    if (this.isAway) throw new TypeError('no network');
    if (pathname === '/token') {
      this.tokens += 1;
      return this.tokens === 1 ? Response.json({ 'auth-token': 'abc' }) : Response.json({ 'error-code': '1' }, { status: 403 });
    }
    const given = headers as { [name: string]: string };
    if (given['X-Experience-API-Version'] !== '1.0.3' || !given['Authorization']?.startsWith('Basic ')) this.faults.push(`headers of ${href}`);
    const told = pathname === '/lrs/statements' ? ([JSON.parse(String(body))].flat() as (typeof this.statements)[number][]) : [];
    const status = this.status(
      method,
      pathname,
      told.map(({ id }) => id),
    );
    if (status !== undefined) return new Response('', { status });
    if (pathname === '/lrs/statements') {
      if (method === 'PUT' && searchParams.get('statementId') !== told[0]?.id) this.faults.push('another id');
      if (told.some(({ id }) => this.statements.some((known) => known.id === id))) return new Response('', { status: 409 });
      this.statements.push(...told);
      if (this.losesAnswers) throw new TypeError('no network');
      return new Response(null, { status: method === 'PUT' ? 204 : 200 });
    }
    if (pathname === '/lrs/agents/profile') {
      const profile = this.profiles.get(searchParams.get('profileId') ?? '');
      return profile === undefined ? new Response('', { status: 404 }) : new Response(profile);
    }
    if (pathname !== '/lrs/activities/state') return new Response('', { status: 404 });
    const key = ['activityId', 'agent', 'registration', 'stateId'].map((name) => searchParams.get(name)).join(' ');
    if (method === 'PUT') {
      this.states.set(key, String(body));
      return new Response(null, { status: 204 });
    }
    const text = this.states.get(key);
    return text === undefined ? new Response('', { status: 404 }) : new Response(text);
  };
}

export const ACTOR = '{"account":{"homePage":"https://a.example","name":"7"}}';
export const REGISTRATION = '2f1b8a3c-7c0e-4f8e-9f60-0a5d3c1b2e4f';
export const COURSE = { activityId: 'https://a.example/course', title: 'A story', language: 'en', watched: 0.9 };
export const SESSION_ID = 'https://w3id.org/xapi/cmi5/context/extensions/sessionid';
export const launchOf = (isCmi5: boolean): string => {
  const asked = {
    endpoint: 'https://lrs.example/lrs',
    actor: ACTOR,
    registration: REGISTRATION,
    ...(isCmi5 ? { fetch: 'https://lrs.example/token', activityId: COURSE.activityId } : { auth: 'Basic xyz' }),
  };
  return `https://a.example/index.html?${new URLSearchParams(asked)}`;
};

/** Configures the launch of a cmi5 course. */
export const prepare = (store: FakeStore, launchMode: string, more: object = {}): void => {
  const data = {
    contextTemplate: { contextActivities: { grouping: [{ id: 'https://a.example/publisher' }] }, extensions: { [SESSION_ID]: 's1' } },
    launchMode,
    moveOn: 'Completed',
    ...more,
  };
  store.states.set([COURSE.activityId, ACTOR, REGISTRATION, 'LMS.LaunchData'].join(' '), JSON.stringify(data));
};

export const shelf = (values = new Map<string, string>()): Shelf & { readonly values: Map<string, string> } => {
  return { values, getItem: (key) => values.get(key) ?? null, setItem: (key, value) => void values.set(key, value), removeItem: (key) => void values.delete(key) };
};

/** Returns the memory of a learner at a position of a course. */
export const memoryAt = (placeSecs: number): Memory => ({ ...NOTHING, session: 1, placeSecs, seen: placeSecs > 0 ? [[0, placeSecs]] : [] });

export const report = (placeSecs: number, isComplete = false): Report => ({
  placeSecs,
  durationSecs: 60,
  progress: placeSecs / 60,
  seen: [[0, placeSecs]],
  isComplete,
  memory: memoryAt(placeSecs),
  score: undefined,
  isSettled: false,
  isPassed: undefined,
});
export const verbs = (store: FakeStore): string[] => store.statements.map(({ verb }) => Object.entries(VERBS).find(([, id]) => id === verb.id)?.[0] ?? verb.id);
/** Resolves when pending requests have arrived; with fake timers, batched statements are sent. */
export const settled = async (): Promise<void> => {
  for (let i = 0; i < 60; i++) await Promise.resolve();
  if (!vi.isFakeTimers()) return;
  await vi.advanceTimersByTimeAsync(1000);
  for (let i = 0; i < 60; i++) await Promise.resolve();
};
