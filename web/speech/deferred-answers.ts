/** Answers that come later, for code that asks, goes on to something else, and asks again. */

/** Answers are kept for questions that are asked again, because others of their utterance were not answered yet. */
const MAX_KEPT = 32;

export class DeferredAnswers<Answer> {
  readonly #answers = new Map<string, Answer>();
  #pending: Promise<void> | undefined;
  #failure: { readonly error: unknown } | undefined;
  /** Ends what is being answered. */
  #abort = new AbortController();

  /** What is being answered, settled once it is or has failed. */
  pending(): Promise<void> | undefined {
    return this.#pending;
  }

  /** The answer to a question; undefined until `make` has it. Throws what failed since it was asked last. */
  ask(question: string, make: (signal: AbortSignal) => Promise<Answer>): Answer | undefined {
    const failure = this.#failure;
    this.#failure = undefined;
    if (failure !== undefined) throw failure.error;
    const known = this.#answers.get(question);
    if (known !== undefined) return known;
    this.#pending ??= this.#make(question, make);
    return undefined;
  }

  /** What is being answered is not wanted any more; the next question is answered at once. */
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
