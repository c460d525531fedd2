/** Kind of build: its wasm files and its page are in `folder` and `site`, relative to the root. */
export interface Kind {
  readonly name: string;
  readonly folder: string;
  readonly site: string;
}

export const kinds: { readonly shipped: Kind; readonly quick: Kind };
