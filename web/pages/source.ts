/**
 * EML text as a tree with source positions, so that a control can change one value and leave every other character unchanged. It accepts any text; anything
 * but markup is text.
 */

import { parser } from '@lezer/xml';

/** Attribute with its source range: `from` to `to` with its quotes, the value between `valueFrom` and `valueTo`. */
export interface Attribute {
  readonly name: string;
  /** Value, with the five predefined entity references of XML resolved. */
  readonly value: string;
  readonly from: number;
  readonly to: number;
  readonly valueFrom: number;
  readonly valueTo: number;
}

/** Element with its source range. */
export interface Element {
  readonly name: string;
  readonly attributes: readonly Attribute[];
  readonly children: readonly Element[];
  readonly parent: Element | undefined;
  readonly from: number;
  /** End of the range, after the end tag. */
  readonly to: number;
  /** End of the start tag. */
  readonly openTo: number;
  /** Position before its end tag; equal to `to` if there is none. */
  readonly closeFrom: number;
  /** `<x/>`. */
  readonly empty: boolean;
}

type GrowingTree = { -readonly [K in keyof Element]: Element[K] } & { attributes: Attribute[]; children: GrowingTree[]; parent: GrowingTree | undefined };

const REFERENCES: Record<string, string> = { amp: '&', lt: '<', gt: '>', quot: '"', apos: "'" };

/** Maximum nesting depth of the tree; deeper elements, which have no meaning, become siblings, so that tree traversal cannot overflow the stack. */
const MAX_DEPTH = 200;

/** Returns the top-level elements of a text, as the editor's grammar finds them in any text. */
export function read(text: string): readonly Element[] {
  const top: GrowingTree[] = [];
  const path: GrowingTree[] = [];
  let named: Pick<Attribute, 'name' | 'from'> | undefined;
  parser.parse(text).iterate({
    enter({ name, from, to }) {
      const open = path.at(-1);
      if (name === 'Element') {
        const parent = path[Math.min(path.length, MAX_DEPTH) - 1];
        path.push({ name: '', attributes: [], children: [], parent, from, to, openTo: to, closeFrom: to, empty: true });
      } else if (open === undefined) {
        return;
      } else if (name === 'TagName' && open.name === '') {
        open.name = text.slice(from, to);
        (open.parent?.children ?? top).push(open);
      } else if (name === 'AttributeName') {
        named = { name: text.slice(from, to), from };
      } else if (name === 'AttributeValue' && named !== undefined) {
        const [valueFrom, valueTo] = [from + 1, to - 1];
        open.attributes.push({ ...named, value: resolve(text.slice(valueFrom, valueTo)), to, valueFrom, valueTo });
        named = undefined;
      } else if (name === 'CloseTag' || name === 'MissingCloseTag') {
        open.closeFrom = from;
      }
    },
    leave({ name, to }) {
      const open = path.at(-1);
      if (open === undefined) return;
      if (name === 'OpenTag' || name === 'SelfClosingTag') {
        open.openTo = to;
        open.empty = name === 'SelfClosingTag';
        if (open.empty) open.closeFrom = to;
      } else if (name === 'Element') {
        path.pop();
      }
    },
  });
  return top;
}

function resolve(raw: string): string {
  return raw.includes('&') ? raw.replace(/&(amp|lt|gt|quot|apos);/g, (whole, name: string) => REFERENCES[name] ?? whole) : raw;
}

/** Yields all descendants, in the order of the text. */
export function* within(elements: readonly Element[]): Generator<Element> {
  for (const element of elements) {
    yield element;
    yield* within(element.children);
  }
}

/** Returns the value of an attribute. */
export function attribute(element: Element, name: string): string | undefined {
  return element.attributes.find((a) => a.name === name)?.value;
}

/** A change of the text: `from` to `to` becomes `insert`. */
export interface Change {
  readonly from: number;
  readonly to: number;
  readonly insert: string;
}

/** Applies changes to a text; they refer to the original positions and must not overlap. */
export function apply(text: string, changes: readonly Change[]): string {
  const sorted = [...changes].sort((a, b) => b.from - a.from || b.to - a.to);
  return sorted.reduce((now, { from, to, insert }) => now.slice(0, from) + insert + now.slice(to), text);
}

const escaped = (value: string): string => value.replace(/&/g, '&amp;').replace(/</g, '&lt;').replace(/"/g, '&quot;').replace(/'/g, '&apos;');

/** Sets an attribute, or removes it if the value is undefined. */
export function setAttribute(element: Element, name: string, value: string | undefined): Change[] {
  const present = element.attributes.find((a) => a.name === name);
  if (present !== undefined) {
    // The preceding space is removed too.
    if (value === undefined) return [{ from: present.from - 1, to: present.to, insert: '' }];
    return value === present.value ? [] : [{ from: present.valueFrom, to: present.valueTo, insert: escaped(value) }];
  }
  if (value === undefined) return [];
  const at = element.attributes.at(-1)?.to ?? element.from + 1 + element.name.length;
  return [{ from: at, to: at, insert: ` ${name}="${escaped(value)}"` }];
}

/** Returns the white space at the start of a position's line; undefined if other text precedes the position. */
function indentation(text: string, at: number): string | undefined {
  const line = text.lastIndexOf('\n', at - 1) + 1;
  const before = text.slice(line, at);
  return /^[ \t]*$/.test(before) ? before : undefined;
}

/** Removes an element, with its line if nothing else is on it. */
export function removeElement(text: string, element: Element): Change {
  const indent = indentation(text, element.from);
  const rest = /^[ \t]*\r?\n/.exec(text.slice(element.to))?.[0];
  if (indent === undefined || rest === undefined) return { from: element.from, to: element.to, insert: '' };
  return { from: element.from - indent.length, to: element.to + rest.length, insert: '' };
}

/** Puts markup into an element before its child `before`, or at its end; each of its lines is indented as its neighbours are. */
export function insertInto(text: string, parent: Element, markup: string, before?: Element): Change {
  const own = indentation(text, parent.from) ?? '';
  const sibling = parent.children[0];
  const indent = (sibling && indentation(text, sibling.from)) ?? `${own}  `;
  const lines = markup.replace(/\n/g, `\n${indent}`);
  if (before !== undefined) {
    return indentation(text, before.from) === undefined
      ? { from: before.from, to: before.from, insert: markup }
      : { from: before.from, to: before.from, insert: `${lines}\n${indent}` };
  }
  if (parent.empty) {
    const slash = text.slice(parent.from, parent.to).search(/\s*\/>$/);
    return { from: parent.from + Math.max(slash, 0), to: parent.to, insert: `>\n${indent}${lines}\n${own}</${parent.name}>` };
  }
  const last = parent.children.at(-1)?.to ?? parent.openTo;
  const alone = indentation(text, parent.closeFrom) !== undefined;
  return { from: last, to: last, insert: `\n${indent}${lines}${alone ? '' : `\n${own}`}` };
}

/** Returns the smallest single change that turns one text into another; undefined if they are equal. */
export function difference(before: string, after: string): Change | undefined {
  if (before === after) return undefined;
  let from = 0;
  const shorter = Math.min(before.length, after.length);
  while (from < shorter && before[from] === after[from]) from += 1;
  let tail = 0;
  while (tail < shorter - from && before[before.length - 1 - tail] === after[after.length - 1 - tail]) tail += 1;
  return { from, to: before.length - tail, insert: after.slice(from, after.length - tail) };
}
