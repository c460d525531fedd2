/** A kind of build: its wasm files and its page lie in `folder` and `site`, from the root. */
export interface Kind {
  readonly name: string;
  readonly folder: string;
  readonly site: string;
}

export const kinds: { readonly shipped: Kind; readonly quick: Kind };
