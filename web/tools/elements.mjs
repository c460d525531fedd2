// Describes the element from its source: `custom-elements.json` for editors and component catalogues, and the reference
// in docs/element.md. `node web/tools/elements.mjs` regenerates the reference.

import { readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';
import { create, ts } from '@custom-elements-manifest/analyzer';
import { runnerImport } from 'vite';
import { main, root } from './steps.mjs';

const SOURCES = ['element', 'player-attributes', 'media-element', 'base/events'];
/** Class whose members are listed as those of a media element; members of other classes are listed as the player's own. */
const INHERITED = 'MediaElement';
const CLASS = 'RaconteurPlayer';
const reference = join(root, 'docs/element.md');

const parse = (name) => ts.createSourceFile(`web/element/${name}.ts`, readFileSync(join(root, `web/element/${name}.ts`), 'utf8'), ts.ScriptTarget.ES2022, true);

/** Returns the members of the event interfaces. */
function eventsOf(source) {
  return source.statements.filter((statement) => ts.isInterfaceDeclaration(statement) && /^(Media|Player)EventMap$/.test(statement.name.text)).flatMap(({ name, members }) =>
    members.map((member) => ({
      name: member.name.text,
      type: { text: member.type.getText() },
      description: ts.getJSDocCommentsAndTags(member).map(({ comment }) => comment).join(' '),
      inheritedFrom: name.text === 'MediaEventMap' ? { name: INHERITED } : undefined,
    })),
  );
}

/** Returns the attributes and the properties that they become. */
async function attributesOf(members) {
  const { module } = await runnerImport(join(root, 'web/element/media/attributes.ts'), { root, configFile: false, logLevel: 'error' });
  return Object.entries({ ...module.mediaAttributes, ...module.attributes }).flatMap(([fieldName, { attribute = fieldName }]) => {
    if (attribute === false) return [];
    const { description, type, inheritedFrom } = members.find(({ name }) => name === fieldName) ?? {};
    return [{ name: attribute, fieldName, type, description, inheritedFrom }];
  });
}

/** Members for pages: neither private ones nor those for the parts of the player. */
const isPublic = ({ privacy, name, static: isStatic }) => privacy === undefined && !isStatic && !/^(#|update|render|willUpdate|performUpdate|connected|disconnected|attributeChanged)/.test(name);

/** Returns the manifest (custom-elements.json, schema 1.0.0); `script` is the module that defines the element, `version` that of the package. */
export async function manifest(script) {
  const sources = SOURCES.map(parse);
  const { schemaVersion, modules } = create({ modules: sources });
  const { description, members, cssProperties, cssParts } = modules.flatMap(({ declarations }) => declarations).find(({ name }) => name === CLASS);
  const shown = members.filter(isPublic).map(({ inheritedFrom, ...member }) => ({ ...member, ...(inheritedFrom?.name === INHERITED && { inheritedFrom: { name: INHERITED } }) }));
  const declaration = {
    kind: 'class',
    customElement: true,
    name: CLASS,
    tagName: 'raconteur-player',
    description,
    superclass: { name: 'LitElement', package: 'lit' },
    attributes: await attributesOf(shown),
    members: shown,
    events: eventsOf(sources.at(-1)),
    cssProperties,
    cssParts,
  };
  const exported = { kind: 'js', name: CLASS, declaration: { name: CLASS, module: script } };
  return { schemaVersion, readme: 'README.md', modules: [{ kind: 'javascript-module', path: script, declarations: [declaration], exports: [exported, { ...exported, kind: 'custom-element-definition', name: 'raconteur-player' }] }] };
}

const line = (text = '') => text.replaceAll(/\s+/g, ' ').trim().replaceAll('|', '\\|');
const table = (heads, rows) => [`| ${heads.join(' | ')} |`, `|${heads.map(() => '---|').join('')}`, ...rows.map((row) => `| ${row.join(' | ')} |`)].join('\n');
const code = (text) => `\`${line(text)}\``;
const call = ({ name, parameters = [] }) => `${name}(${parameters.map((p) => (p.optional || p.default !== undefined ? `${p.name}?` : p.name)).join(', ')})`.replaceAll(/\{[^}]*\}/g, 'options');

/** Returns the reference of the element, in Markdown. */
export async function referenceText() {
  const [{ declarations: [{ attributes, members, events, cssProperties, cssParts }] }] = (await manifest('')).modules;
  const own = (list) => list.filter(({ inheritedFrom }) => inheritedFrom === undefined);
  const media = (list) => list.filter(({ inheritedFrom }) => inheritedFrom !== undefined);
  const named = new Set(attributes.map(({ fieldName }) => fieldName));
  const fields = (list) => table(['property', 'type', 'description'], list.filter(({ kind }) => kind === 'field').map(({ name, type, readonly, description }) => [code(name), code(type?.text), `${readonly ? 'Read only. ' : ''}${line(description)}`]));
  const methods = (list) => table(['method', 'returns', 'description'], list.filter(({ kind }) => kind === 'method').map((method) => [code(call(method)), code(method.return?.type?.text ?? 'void'), line(method.description)]));
  const told = (list) => table(['event', 'type', 'description'], list.map(({ name, type, description }) => [code(name), code(type.text), line(description)]));
  const plain = (list) => table(['name', 'description'], list.map(({ name, description }) => [code(name), line(description)]));
  return `# \`<raconteur-player>\`

The reference of the element, generated from its source by \`web/tools/elements.mjs\`. The element implements the
interface of an HTML media element, so code written for \`<video>\` can drive it, and that of a storyteller. See
[embedding](embedding.md) for how to add it to a page.

## Attributes

${table(['attribute', 'type', 'description'], attributes.map(({ name, type, description }) => [code(name), code(type?.text), line(description)]))}

## As a media element

${fields(media(members).filter(({ name }) => !named.has(name)))}

${methods(media(members))}

${told(media(events))}

## As a storyteller

${fields(own(members).filter(({ name }) => !named.has(name)))}

${methods(own(members))}

${told(own(events))}

## Styling

Custom properties:

${plain(cssProperties)}

Parts, for \`::part()\`:

${plain(cssParts)}
`;
}

if (process.argv[1] === import.meta.filename) {
  await main(async () => writeFileSync(reference, await referenceText()));
}
