import { describe, expect, it } from 'vitest';
import { addressOf } from '../element/animations.js';

const library = new URL('https://example.org/assets/');
const story = new URL('https://example.org/stories/rabbit/story.eml');
const address = (name: string) => addressOf(name, library, story)?.href;

describe('addresses of animations', () => {
  it('takes bare names from the library', () => {
    expect(address('step-march')).toBe('https://example.org/assets/animations/step-march.json');
  });
  it('takes paths from the folder of the story', () => {
    expect(address('moves/jump.json')).toBe('https://example.org/stories/rabbit/moves/jump.json');
    expect(address('dance.glb#Jump')).toBe('https://example.org/stories/rabbit/dance.glb#Jump');
  });
  it('does not leave the folder', () => {
    expect(address('../other/x.json')).toBeUndefined();
    expect(address('/x.json')).toBeUndefined();
    expect(address('https://elsewhere.example/x.json')).toBeUndefined();
    expect(address('//elsewhere.example/x.json')).toBeUndefined();
  });
});
