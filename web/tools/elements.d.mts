/** Description of a part of an element. */
export interface Described {
  readonly name: string;
  readonly description?: string;
}

/** An element in a custom-elements manifest. */
export interface Declaration {
  readonly attributes: readonly Described[];
  readonly members: readonly Described[];
  readonly events: readonly Described[];
  readonly cssProperties: readonly Described[];
  readonly cssParts: readonly Described[];
}

export function manifest(script: string): Promise<{ readonly modules: readonly { readonly declarations: readonly Declaration[] }[] }>;
export function referenceText(): Promise<string>;
