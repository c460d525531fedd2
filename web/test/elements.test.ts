import { readFileSync } from 'node:fs';
import { join } from 'node:path';
import { beforeAll, describe, expect, it } from 'vitest';
import { manifest, referenceText, type Declaration } from '../tools/elements.mjs';

const root = join(import.meta.dirname, '../..');
const read = (path: string): string => readFileSync(join(root, path), 'utf8');
const names = (list: readonly { name: string }[]): string[] => list.map(({ name }) => name).sort();
const found = (text: string, pattern: RegExp): string[] => [...new Set([...text.matchAll(pattern)].flatMap(([, name = '']) => name.split(' ')))].sort();

describe('What the element is said to be', () => {
  let element: Declaration;
  beforeAll(async () => {
    const { modules } = await manifest('dist/player.js');
    const [declaration] = modules[0]?.declarations ?? [];
    if (declaration === undefined) throw new Error('no element');
    element = declaration;
  });

  it('is what docs/element.md says', async () => {
    expect(read('docs/element.md')).toBe(await referenceText());
  });

  it('is what its styles and templates have', () => {
    expect(names(element.cssProperties)).toEqual(found(read('web/element/element.css'), /var\((--raconteur-[\w-]+)/g));
    expect(names(element.cssParts)).toEqual(
      found(
        ['controls/controls', 'controls/caption-menu', 'template', 'lesson/question', 'lesson/question-fields'].map((part) => read(`web/element/${part}.ts`)).join(''),
        /part="([\w -]+)"/g,
      ),
    );
  });

  it('tells of each attribute, property, method and event what it is', () => {
    const told = [...element.attributes, ...element.members, ...element.events, ...element.cssProperties, ...element.cssParts];
    expect(told.filter(({ description }) => !description?.trim()).map(({ name }) => name)).toEqual([]);
    expect(told.length).toBeGreaterThan(100);
  });

  it('has the events that are dispatched', () => {
    const told = [
      'media-element',
      'story/story-loader',
      'media/playback',
      'story/cues',
      'element',
      'media/transport',
      'base/clock',
      'sound/outputs',
      'story/sound',
      'story/figure-loader',
      'mind/mind-connection',
      'base/diagnostics',
      'lesson/questioner',
    ]
      .map((part) => read(`web/element/${part}.ts`))
      .join('\n');
    const dispatched = names(element.events).filter((name) => told.includes(`'${name}'`));
    expect(dispatched).toEqual(names(element.events));
  });
});
