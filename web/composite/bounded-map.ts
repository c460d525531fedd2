/** A map with limited size that removes its oldest entries. */
export class BoundedMap<K, V> {
  readonly #map = new Map<K, V>();

  constructor(private readonly most: number) {}

  set(key: K, value: V): void {
    this.#map.delete(key);
    this.#map.set(key, value);
    for (const old of this.#map.keys()) {
      if (this.#map.size <= this.most) break;
      this.#map.delete(old);
    }
  }

  get(key: K): V | undefined {
    return this.#map.get(key);
  }

  get size(): number {
    return this.#map.size;
  }

  clear(): void {
    this.#map.clear();
  }
}
