/** A learning record store, as xAPI 1.0.3 has it (part three, 2.1 and 2.3). */

import type { Outcome, Statement } from './outbox.js';

/** Where it is and what it is asked with. */
export interface Access {
  /** Ends with a slash. */
  readonly endpoint: string;
  /** The header `Authorization`. */
  readonly authorization: string;
}

/** Whose state is kept. */
export interface Owner {
  readonly activityId: string;
  /** As the launch gave it. */
  readonly agent: string;
  readonly registration: string | undefined;
}

const VERSION = '1.0.3';
/** A browser sends 64 KiB for pages that go (Fetch, 4.6); a character has at most three bytes. */
const MOST_KEPT = 16_000;

export class RecordStore {
  readonly #access: Access;

  constructor(access: Access) {
    this.#access = access;
  }

  /** Puts a statement under its id. A page that goes may still send it. */
  async put(statement: Statement): Promise<Outcome> {
    try {
      const { ok, status } = await this.#ask('PUT', 'statements', { statementId: statement.id }, JSON.stringify(statement));
      // It has one of this id: the answer to an earlier try was lost.
      if (ok || status === 409) return 'taken';
      return status >= 500 || status === 429 || status === 408 ? 'away' : 'refused';
    } catch {
      return 'away';
    }
  }

  /** A document of the state of a learner in an activity; empty where there is none, undefined where the store cannot be asked. */
  async state(owner: Owner, id: string): Promise<string | undefined> {
    try {
      const response = await this.#ask('GET', 'activities/state', query(owner, id));
      if (response.status === 404) return '';
      return response.ok ? await response.text() : undefined;
    } catch {
      return undefined;
    }
  }

  /** Whether the store has it. */
  async putState(owner: Owner, id: string, text: string): Promise<boolean> {
    try {
      return (await this.#ask('PUT', 'activities/state', query(owner, id), text)).ok;
    } catch {
      return false;
    }
  }

  #ask(method: string, resource: string, asked: { readonly [name: string]: string }, body?: string): Promise<Response> {
    const { endpoint, authorization } = this.#access;
    const headers: { [name: string]: string } = { Authorization: authorization, 'X-Experience-API-Version': VERSION };
    if (body !== undefined) headers['Content-Type'] = 'application/json';
    // What is long cannot outlive the page: browsers refuse it then.
    const keepalive = (body?.length ?? 0) <= MOST_KEPT;
    return fetch(`${endpoint}${resource}?${new URLSearchParams(asked)}`, { method, headers, keepalive, ...(body === undefined ? {} : { body }) });
  }
}

const query = ({ activityId, agent, registration }: Owner, stateId: string): { [name: string]: string } => ({
  activityId,
  agent,
  stateId,
  ...(registration === undefined ? {} : { registration }),
});
