// Cuts a module in two: what is needed only by some stories, or later, goes into a file of its own.
//
// Doors are functions that the rest of the program calls only once it knows that the other
// file is there; what can be reached through doors alone goes with them. In their place stay
// calls by the table, whose last places the other file fills when it joins the instance.
// The text form is cut, since binaryen's programs give and take it. Only Node's own modules.

import { readFileSync, writeFileSync } from 'node:fs';

const NAME = String.raw`\$(?:"(?:[^"\\]|\\.)*"|[^\s()]+)`;
const FUNCTION = new RegExp(String.raw`^ \(func (${NAME})((?: \((?:type|param|result)[^()]*\))*)`);
const CALL = new RegExp(String.raw`\((?:return_call|call|ref\.func) (${NAME})`, 'g');
const EXPORTED = new RegExp(String.raw`^ \(export "[^"]*" \(func (${NAME})`);
const IMPORTED = new RegExp(String.raw`^ \(import .*\(func (${NAME})((?: \((?:type|param|result)[^()]*\))*)`);
const TABLE = /^ \(table \$0 (\d+) (\d+) funcref\)/;
const GLOBAL = /^ \(global (\$\S+) \(mut i32\)/;
const LETTERS = 'abcdefghijklmnopqrstuvwxyz';

/** The nth shortest name of small letters. */
const short = (n) => (n >= LETTERS.length ? short(Math.floor(n / LETTERS.length) - 1) : '') + LETTERS[n % LETTERS.length];

/** The forms of a module's text, in their order. */
function forms(text) {
  const lines = text.split('\n');
  const found = [];
  for (const line of lines.slice(1, lines.lastIndexOf(')'))) {
    if (line.startsWith(' (') || found.length === 0) found.push([line]);
    else found.at(-1).push(line);
  }
  return found.map((form) => form.join('\n'));
}

/** Everything that calls lead to from `roots`, without passing through `shut`. */
function reached(roots, calls, shut) {
  const seen = new Set();
  const left = [...roots];
  for (let name = left.pop(); name !== undefined; name = left.pop()) {
    if (seen.has(name) || shut.has(name)) continue;
    seen.add(name);
    left.push(...(calls.get(name) ?? []));
  }
  return seen;
}

/** A call by the table in the place of a function. */
function byTable(name, signature, place) {
  const [params, results] = ['param', 'result'].map((kind) => [...signature.matchAll(new RegExp(String.raw`\(${kind} ([^()]*)\)`, 'g'))].map((m) => m[1]));
  // Parameters come with their names, one a form.
  const types = params.map((param) => param.split(' ').at(-1));
  const type = [...types.map((t) => `(param ${t})`), ...results.map((r) => `(result ${r})`)].join(' ');
  const args = types.map((_, i) => `(local.get ${i})`).join(' ');
  return ` (func ${name} ${type} (call_indirect $0 ${type} ${args} (i32.const ${place})))`;
}

/**
 * Cuts the text of a module at the functions whose names match `door`: the text of the module
 * without them, and of the one that has them, whose imports are the first one's exports. Their
 * names begin with `mark`, so that a module can be cut again.
 */
export function cut(text, door, mark = '') {
  const all = forms(text);
  const bodies = new Map();
  const signatures = new Map();
  const calls = new Map();
  const roots = new Set();
  for (const form of all) {
    const [, name, signature] = FUNCTION.exec(form) ?? IMPORTED.exec(form) ?? [];
    if (name !== undefined) {
      signatures.set(name, signature);
      if (form.startsWith(' (func')) {
        bodies.set(name, form);
        calls.set(name, new Set([...form.matchAll(CALL)].map((m) => m[1])));
      }
    }
    const exported = EXPORTED.exec(form);
    if (exported !== null) roots.add(exported[1]);
    // The names of segment and table are nobody's, and lead nowhere.
    if (form.startsWith(' (elem')) for (const m of form.matchAll(new RegExp(NAME, 'g'))) roots.add(m[0]);
    if (form.startsWith(' (start')) throw new Error('a module that starts by itself cannot be cut');
  }
  const doors = [...bodies.keys()].filter((name) => door.test(name));
  if (doors.length === 0) throw new Error(`no function matches ${door}`);
  const kept = reached(roots, calls, new Set(doors));
  const moved = new Set([...reached(doors, calls, kept)]);
  // A function that was there for nobody goes with neither.
  const called = new Set();
  for (const name of moved) for (const other of calls.get(name)) if (!moved.has(other)) called.add(other);
  const names = new Map([...called].map((name, i) => [name, mark + short(i)]));

  let first;
  let globals = [];
  const rest = all.flatMap((form) => {
    const table = TABLE.exec(form);
    if (table !== null) {
      if (table[1] !== table[2]) throw new Error('the table of functions may grow');
      first = Number(table[1]);
      return [` (table $0 ${first + doors.length} ${first + doors.length} funcref)`];
    }
    const global = GLOBAL.exec(form);
    if (global !== null) globals.push(global[1]);
    const name = FUNCTION.exec(form)?.[1];
    if (name === undefined) return [form];
    if (doors.includes(name)) return [byTable(name, signatures.get(name), first + doors.indexOf(name))];
    return kept.has(name) ? [form] : [];
  });
  const memory = all.find((form) => form.startsWith(' (memory $0 '));
  const movedBodies = [...moved].map((name) => bodies.get(name));
  globals = globals.filter((name) => movedBodies.some((body) => body.includes(`${name}\n`) || body.includes(`${name})`) || body.includes(`${name} `)));
  const exports = [
    ` (export "${mark}0" (table $0))`,
    ...globals.map((name, i) => ` (export "${mark}${i + 1}" (global ${name}))`),
    ...[...names].map(([name, as]) => ` (export "${as}" (func ${name}))`),
  ];
  const imports = [
    ` (import "." "memory" ${memory.trim()})`,
    // No upper limit: another cut makes the table longer.
    ` (import "." "${mark}0" (table $0 ${first + doors.length} funcref))`,
    ...globals.map((name, i) => ` (import "." "${mark}${i + 1}" (global ${name} (mut i32)))`),
    ...[...names].map(([name, as]) => ` (import "." "${as}" (func ${name}${signatures.get(name)}))`),
  ];
  const types = all.filter((form) => form.startsWith(' (type') || form.startsWith(' (rec'));
  const places = ` (elem (table $0) (i32.const ${first}) func ${doors.join(' ')})`;
  const module = (parts) => `(module\n${parts.join('\n')}\n)\n`;
  return [module([...rest, ...exports]), module([...types, ...imports, places, ...movedBodies])];
}

/**
 * Cuts the module in the text file `file` as often as there are `parts`: each has its doors, the
 * mark of its names and the text file that it goes to.
 */
export function split(file, parts) {
  let rest = readFileSync(file, 'utf8');
  for (const { doors, mark, to } of parts) {
    let moved;
    [rest, moved] = cut(rest, doors, mark);
    writeFileSync(to, moved);
  }
  writeFileSync(file, rest);
}
