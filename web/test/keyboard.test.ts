import { beforeEach, expect, test, vi } from 'vitest';
import { handleKey, type KeyActions } from '../element/controls/keyboard.js';

/** Subset of an element used by the keyboard code. */
class FakeElement {
  constructor(readonly selectors: string) {}
  matches(list: string): boolean {
    return list.split(', ').some((one) => one === this.selectors);
  }
}
vi.stubGlobal('HTMLElement', FakeElement);

const actions = {
  toggle: vi.fn(),
  seekBy: vi.fn(),
  seekToShare: vi.fn(),
  volumeBy: vi.fn(),
  toggleMuted: vi.fn(),
  toggleCaptions: vi.fn(),
  toggleFullscreen: vi.fn(),
  dismiss: vi.fn(() => true),
} satisfies KeyActions;

beforeEach(() => vi.clearAllMocks());

const press = (key: string, more: Partial<KeyboardEvent> = {}, target?: FakeElement) =>
  handleKey({ key, ...more } as KeyboardEvent, target as unknown as HTMLElement | undefined, actions);

test('the keys of a video player', () => {
  for (const key of [' ', 'ArrowLeft', 'ArrowRight', 'ArrowUp', 'ArrowDown', 'm', 'C', 'f', 'Escape', 'End', '5']) {
    expect(press(key)).toBe(true);
  }
  expect(actions.toggle).toHaveBeenCalledOnce();
  expect(actions.seekBy.mock.calls).toEqual([[-5], [5]]);
  expect(actions.volumeBy.mock.calls).toEqual([[0.1], [-0.1]]);
  expect(actions.toggleMuted).toHaveBeenCalledOnce();
  expect(actions.toggleCaptions).toHaveBeenCalledOnce();
  expect(actions.toggleFullscreen).toHaveBeenCalledOnce();
  expect(actions.dismiss).toHaveBeenCalledOnce();
  expect(actions.seekToShare.mock.calls).toEqual([[1], [0.5]]);
});

test('other keys, and keys of the browser, are left alone', () => {
  expect(press('Tab')).toBe(false);
  expect(press('f', { ctrlKey: true })).toBe(false);
  expect(press('c', { metaKey: true })).toBe(false);
});

test('a control keeps the keys it uses itself', () => {
  expect(press(' ', {}, new FakeElement('button'))).toBe(false);
  expect(press('m', {}, new FakeElement('button'))).toBe(true);
  expect(press('ArrowUp', {}, new FakeElement('select'))).toBe(false);
  expect(press('ArrowUp', {}, new FakeElement('input.volume'))).toBe(false);
  expect(press('ArrowUp', {}, new FakeElement('input.seek'))).toBe(true);
});

test('a key held down toggles once', () => {
  press(' ');
  press(' ', { repeat: true });
  expect(actions.toggle).toHaveBeenCalledOnce();
});
