/** Values that a page keeps in the browser's storage, if the browser provides any. */

export class StoredText {
  readonly #key: string;
  readonly #storage: () => Storage;

  /** Access to a storage may itself be refused, so it is asked for with each value. */
  constructor(key: string, storage: () => Storage) {
    this.#key = key;
    this.#storage = storage;
  }

  /** Stores a value; false if the storage is full or refused. */
  set(value: string): boolean {
    try {
      this.#storage().setItem(this.#key, value);
      return true;
    } catch {
      return false;
    }
  }

  get(): string | undefined {
    try {
      return this.#storage().getItem(this.#key) ?? undefined;
    } catch {
      return undefined;
    }
  }

  forget(): void {
    try {
      this.#storage().removeItem(this.#key);
    } catch {
      // Nothing was stored.
    }
  }
}
