/** A learning record store, as xAPI 1.0.3 has it (part three, 2.1 to 2.6). */

/** A statement of xAPI; its `id` makes sending it twice the same as sending it once. */
export interface Statement {
  readonly id: string;
  readonly [part: string]: unknown;
}

/** Address and credentials of the store. */
export interface Access {
  /** Ends with a slash. */
  readonly endpoint: string;
  /** The header `Authorization`. */
  readonly authorization: string;
}

/** Owner of a stored state. */
export interface Owner {
  readonly activityId: string;
  /** Agent, exactly as the launch gave it. */
  readonly agent: string;
  readonly registration: string | undefined;
}

/**
 * Outcome of a request: the store has it (`taken`), is unreachable or busy (`away`), no longer admits the course (`denied`), or rejects the data (`refused`).
 */
export type Outcome = 'taken' | 'away' | 'denied' | 'refused';

const VERSION = '1.0.3';
/** A browser sends 64 KiB for pages that go (Fetch, 4.6), in all requests together. */
export const MAX_KEPT_BYTES = 60_000;

export const bytesOf = (text: string): number => new TextEncoder().encode(text).length;

function outcomeOf(status: number): Outcome {
  if (status >= 200 && status < 300) return 'taken';
  if (status === 401 || status === 403) return 'denied';
  return status >= 500 || status === 429 || status === 408 ? 'away' : 'refused';
}

export class RecordStore {
  readonly #access: Access;

  constructor(access: Access) {
    this.#access = access;
  }

  /** Sends statements atomically. Also works while a page closes. */
  async send(statements: readonly Statement[]): Promise<Outcome> {
    const [first, ...more] = statements;
    if (first === undefined) return 'taken';
    const sent =
      more.length > 0 ? this.#ask('POST', 'statements', {}, JSON.stringify(statements)) : this.#ask('PUT', 'statements', { statementId: first.id }, JSON.stringify(first));
    const status = await statusOf(sent);
    // It has one of this id: the answer to an earlier try was lost.
    return status === 409 && more.length === 0 ? 'taken' : outcomeOf(status);
  }

  /** Reads a document of a learner's state in an activity; its text is empty if there is none. */
  state(owner: Owner, id: string): Promise<{ readonly outcome: Outcome; readonly text: string }> {
    return this.#document('activities/state', query(owner, id));
  }

  /** Reads a document of a learner's profile, independent of activities. */
  profile({ agent }: Owner, profileId: string): Promise<{ readonly outcome: Outcome; readonly text: string }> {
    return this.#document('agents/profile', { agent, profileId });
  }

  async putState(owner: Owner, id: string, text: string): Promise<Outcome> {
    return outcomeOf(await statusOf(this.#ask('PUT', 'activities/state', query(owner, id), text)));
  }

  async #document(resource: string, asked: { readonly [name: string]: string }): Promise<{ readonly outcome: Outcome; readonly text: string }> {
    try {
      const response = await this.#ask('GET', resource, asked);
      if (response.status === 404) return { outcome: 'taken', text: '' };
      const outcome = outcomeOf(response.status);
      return { outcome, text: outcome === 'taken' ? await response.text() : '' };
    } catch {
      return { outcome: 'away', text: '' };
    }
  }

  #ask(method: string, resource: string, asked: { readonly [name: string]: string }, body?: string): Promise<Response> {
    const { endpoint, authorization } = this.#access;
    const headers: { [name: string]: string } = { Authorization: authorization, 'X-Experience-API-Version': VERSION };
    if (body !== undefined) headers['Content-Type'] = 'application/json';
    // A long request cannot outlive the page: browsers reject it.
    const keepalive = body !== undefined && bytesOf(body) <= MAX_KEPT_BYTES;
    const parts = new URLSearchParams(asked).toString();
    return fetch(`${endpoint}${resource}${parts === '' ? '' : `?${parts}`}`, { method, headers, keepalive, ...(body === undefined ? {} : { body }) });
  }
}

/** Returns the status of a response; 503 if there is none. */
const statusOf = (response: Promise<Response>): Promise<number> =>
  response.then(
    ({ status }) => status,
    () => 503,
  );

const query = ({ activityId, agent, registration }: Owner, stateId: string): { [name: string]: string } => ({
  activityId,
  agent,
  stateId,
  ...(registration === undefined ? {} : { registration }),
});
