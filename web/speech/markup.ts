/** EML generation. */

const digits = (n: number): string => String(Number(n.toFixed(4)));
const escaped = (text: string): string => text.replace(/[&<>"']/g, (c) => `&#${c.charCodeAt(0)};`);

/** Returns a tag with its attributes, without undefined ones, and its children on separate lines. Numbers have at most four decimals. */
export function tag(name: string, attributes: Readonly<Record<string, string | number | boolean | undefined>>, children: readonly string[] = []): string {
  const written = Object.entries(attributes).flatMap(([key, value]) =>
    value === undefined ? [] : ` ${key}="${escaped(typeof value === 'number' ? digits(value) : String(value))}"`,
  );
  const head = `<${name}${written.join('')}`;
  if (children.length === 0) return `${head}/>`;
  const [only = ''] = children;
  // Short elements are written on one line.
  if (children.length === 1 && name === 'tracks') return `${head}>${only}</${name}>`;
  return `${head}>${children.map((child) => `\n${child.replace(/^/gm, '  ')}`).join('')}\n</${name}>`;
}

/** Returns a complete script; `extended` if it uses the extensions, whose prefix is `r`. */
export function script(name: string, extended: boolean, clauses: readonly string[], head: readonly string[] = []): string {
  const parts = [...(head.length > 0 ? [tag('head', {}, head)] : []), tag('body', {}, clauses)];
  return `${tag('eml', { 'xmlns:r': extended ? 'urn:raconteur:eml:1' : undefined, name }, parts)}\n`;
}
