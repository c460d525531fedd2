/** Asynchronous answers for synchronous code that asks repeatedly. */

/** Maximum number of stored answers, for questions repeated because others of their utterance were pending. */
const MAX_KEPT = 32;

export class DeferredAnswers<Answer> {
  readonly #answers = new Map<string, Answer>();
  #pending: Promise<void> | undefined;
  #failure: { readonly error: unknown } | undefined;
  /** Controller of the pending answer. */
  #abort = new AbortController();

  /** Returns a promise that settles when the pending answer succeeds or fails. */
  pending(): Promise<void> | undefined {
    return this.#pending;
  }

  /** Returns the answer to a question; undefined until `make` provides it. Throws errors that occurred since the last call. */
  ask(question: string, make: (signal: AbortSignal) => Promise<Answer>): Answer | undefined {
    const failure = this.#failure;
    this.#failure = undefined;
    if (failure !== undefined) throw failure.error;
    const known = this.#answers.get(question);
    if (known !== undefined) return known;
    this.#pending ??= this.#make(question, make);
    return undefined;
  }

  /** Cancels the pending answer; the next question is handled immediately. */
  forget(): void {
    this.#abort.abort();
    this.#abort = new AbortController();
    this.#pending = this.#failure = undefined;
  }

  async #make(question: string, make: (signal: AbortSignal) => Promise<Answer>): Promise<void> {
    const { signal } = this.#abort;
    try {
      const answer = await make(signal);
      if (signal.aborted) return;
      this.#answers.set(question, answer);
      const [oldest] = this.#answers.keys();
      if (this.#answers.size > MAX_KEPT && oldest !== undefined) this.#answers.delete(oldest);
    } catch (error) {
      if (signal.aborted) return;
      this.#failure = { error };
    }
    this.#pending = undefined;
  }
}
