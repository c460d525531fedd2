import { expect, test } from 'vitest';
import { UndoStack } from '../pages/undo.js';

test('a change is a step, and steps are undone and redone in their order', () => {
  const stack = new UndoStack({ n: 0 });
  expect([stack.canUndo, stack.canRedo, stack.isInitial, stack.undo(), stack.redo()]).toEqual([false, false, true, undefined, undefined]);
  expect([stack.settle({ n: 1 }), stack.settle({ n: 1 }), stack.settle({ n: 2 })]).toEqual([true, false, true]);
  expect([stack.undo(), stack.undo(), stack.undo()]).toEqual([{ n: 1 }, { n: 0 }, undefined]);
  expect([stack.isInitial, stack.canUndo, stack.canRedo]).toEqual([true, false, true]);
  expect([stack.redo(), stack.redo(), stack.redo()]).toEqual([{ n: 1 }, { n: 2 }, undefined]);
});

test('a new change takes the place of what was undone', () => {
  const stack = new UndoStack('a');
  stack.settle('b');
  stack.undo();
  stack.settle('c');
  expect([stack.canRedo, stack.redo(), stack.undo(), stack.redo()]).toEqual([false, undefined, 'a', 'c']);
});

test('what was settled is kept as it was, and no more than two hundred steps of it', () => {
  const state = { list: [0] };
  const stack = new UndoStack(state);
  for (let i = 1; i <= 250; i++) {
    state.list.push(i);
    stack.settle(state);
  }
  let steps = 0;
  let first: { list: number[] } | undefined;
  for (let back = stack.undo(); back !== undefined; back = stack.undo()) {
    steps++;
    first = back;
  }
  expect([steps, first?.list.length]).toEqual([200, 51]);
});
