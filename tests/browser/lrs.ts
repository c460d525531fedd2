/** Learning record store for browser tests: accepts the data that xAPI 1.0.3 permits, and can be unavailable. */

import type { BrowserContext } from '@playwright/test';

export interface Statement {
  readonly id: string;
  readonly timestamp: string;
  readonly verb: { readonly id: string };
  readonly object: { readonly id: string };
  readonly result?: { readonly success?: boolean; readonly response?: string; readonly score?: { readonly raw?: number; readonly scaled: number } };
  readonly context: { readonly extensions: { readonly [name: string]: unknown } };
}

/** A fault of the store; with `lost`, it accepts the data, but its response is lost. */
export type Fault = 'away' | 'lost' | 401 | 500;

export const verbOf = ({ verb }: Statement): string => verb.id.split('/').at(-1) ?? '';

const HOME = 'https://lrs.test/';
const CORS = { 'access-control-allow-origin': '*', 'access-control-allow-headers': '*', 'access-control-allow-methods': '*' };
const REGISTRATION = '2f1b8a3c-7c0e-4f8e-9f60-0a5d3c1b2e4f';
const ACTOR = '{"account":{"homePage":"https://a.example","name":"7"}}';

export class Lrs {
  readonly statements: Statement[] = [];
  readonly #documents = new Map<string, string>();
  fault: Fault | undefined;

  constructor(launchData: object) {
    this.#documents.set('LMS.LaunchData', JSON.stringify(launchData));
  }

  /** Returns the address of a page that is launched with the store. */
  launch(page: string, isCmi5: boolean): string {
    const asked = { endpoint: `${HOME}xapi/`, actor: ACTOR, registration: REGISTRATION, activityId: 'https://a.example/course' };
    return `${page}?${new URLSearchParams({ ...asked, ...(isCmi5 ? { fetch: `${HOME}token` } : { auth: 'Basic x' }) })}`;
  }

  async serve(context: BrowserContext): Promise<void> {
    await context.route(`${HOME}**`, async (route) => {
      const request = route.request();
      if (request.method() === 'OPTIONS') return route.fulfill({ status: 204, headers: CORS });
      const fault = this.fault;
      if (fault === 'away') return route.abort();
      const answer = (status: number, body = '') => (fault === 'lost' ? route.abort() : route.fulfill({ status: typeof fault === 'number' ? fault : status, headers: CORS, body }));
      const url = new URL(request.url());
      if (url.pathname === '/token') return route.fulfill({ headers: CORS, body: '{"auth-token":"x"}' });
      if (typeof fault === 'number') return answer(fault);
      if (url.pathname.endsWith('/statements')) return this.#take([request.postDataJSON() as Statement | Statement[]].flat(), answer);
      const id = url.searchParams.get('stateId') ?? url.searchParams.get('profileId') ?? '';
      if (request.method() === 'PUT') {
        this.#documents.set(id, request.postData() ?? '');
        return answer(204);
      }
      const text = this.#documents.get(id);
      return text === undefined ? answer(404) : answer(200, text);
    });
  }

  #take(statements: readonly Statement[], answer: (status: number, body?: string) => Promise<void>): Promise<void> {
    if (statements.some(({ id }) => this.statements.some((known) => known.id === id))) return answer(409);
    this.statements.push(...statements);
    return answer(200, '[]');
  }
}
