/**
 * Text editor with its history: controls edit the text, so one undo list covers both. CodeMirror adds its style sheets to its shadow root, which a strict
 * policy allows; in a document it would add a style element, which the policy forbids.
 */

import { defaultKeymap, history, historyKeymap, redo, redoDepth, undo, undoDepth } from '@codemirror/commands';
import { xml } from '@codemirror/lang-xml';
import { bracketMatching, HighlightStyle, indentOnInput, syntaxHighlighting } from '@codemirror/language';
import { lintGutter, setDiagnostics, type Diagnostic as Mark } from '@codemirror/lint';
import { Annotation, EditorState, Transaction } from '@codemirror/state';
import { drawSelection, EditorView, highlightActiveLine, highlightSpecialChars, keymap } from '@codemirror/view';
import { tags } from '@lezer/highlight';
import type { Diagnostic, Place } from '../../element/base/types.js';
import { lineNumbers } from './line-numbers.js';
import type { Change } from '../source.js';

const look = EditorView.theme({
  '&': { color: 'var(--code-ink)', backgroundColor: 'var(--code)', height: '100%', fontSize: 'var(--code-size, 13px)' },
  '&.cm-focused': { outline: '3px solid var(--accent-on-code)', outlineOffset: '-3px' },
  '.cm-scroller': { fontFamily: 'var(--mono)', lineHeight: '1.6' },
  '.cm-content': { caretColor: 'var(--glow)', padding: '12px 0' },
  '.cm-cursor': { borderLeftColor: 'var(--glow)', borderLeftWidth: '2px' },
  '.cm-gutters': { backgroundColor: 'transparent', color: '#9d8d9b', border: 'none' },
  '.cm-activeLine': { backgroundColor: 'rgb(255 255 255 / 5%)' },
  '.cm-selectionBackground, &.cm-focused > .cm-scroller > .cm-selectionLayer .cm-selectionBackground': { background: 'rgb(242 178 92 / 32%)' },
  '.cm-matchingBracket, &.cm-focused .cm-matchingBracket': { backgroundColor: 'rgb(242 178 92 / 28%)' },
  '.cm-tooltip': {
    backgroundColor: '#3a2e42',
    color: 'var(--code-ink)',
    border: '1px solid #5a4a63',
    borderRadius: '8px',
    fontFamily: 'var(--sans)',
    fontSize: '13.5px',
    maxWidth: '40ch',
  },
  '.cm-diagnostic': { borderLeft: '3px solid #ff8f70', padding: '6px 10px' },
  '.cm-diagnostic-warning': { borderLeftColor: 'var(--glow)' },
});

const colours = HighlightStyle.define([
  { tag: tags.tagName, color: '#f2b25c' },
  { tag: tags.attributeName, color: '#c9d8a5' },
  { tag: tags.attributeValue, color: '#8fd0e0' },
  { tag: [tags.angleBracket, tags.definitionOperator], color: '#b9a9b4' },
  { tag: [tags.comment, tags.processingInstruction], color: '#a697a6', fontStyle: 'italic' },
  { tag: tags.invalid, color: '#ff9e85' },
]);

/** Annotation of changes made by a control: true continues the previous undo step, false begins one. */
const goesOn = Annotation.define<boolean>();
/** Typing pause that begins a new undo step. */
const TYPING_PAUSE_MS = 700;

/** Grouping of changes into undo steps: the movement of a control, or typing without a pause. */
class Steps {
  #typedAt = -Infinity;

  /** Returns true if a change belongs to the previous step. */
  readonly join = (transaction: Transaction, adjacent: boolean): boolean => transaction.annotation(goesOn) ?? (adjacent && timeOf(transaction) - this.#typedAt < TYPING_PAUSE_MS);

  /** Records a change. */
  note(transaction: Transaction): void {
    if (transaction.docChanged) this.#typedAt = transaction.annotation(goesOn) === undefined ? timeOf(transaction) : -Infinity;
  }
}

const timeOf = (transaction: Transaction): number => transaction.annotation(Transaction.time) ?? 0;

/**
 * Handles text typed over a selection. By default Chromium copies the look of the replaced text as an inline style, which the policy forbids with an error
 * message.
 */
function typedOver(event: InputEvent, view: EditorView): boolean {
  const { data, inputType, isComposing } = event;
  if (inputType !== 'insertText' || data === null || isComposing || (view.state.selection.main.empty && !data.includes('\n'))) return false;
  view.dispatch(view.state.replaceSelection(data), { userEvent: 'input.type', scrollIntoView: true });
  return true;
}

/** Events from the editor to the page. */
export interface EditorEvents {
  /** Called when the text has changed. */
  text(text: string): void;
  /** Called when undo or redo becomes available or unavailable. */
  moved(): void;
}

export class Editor {
  readonly #view: EditorView;
  /** A control is being moved. */
  #moving = false;

  constructor(host: HTMLElement, label: string, text: string, events: EditorEvents) {
    const steps = new Steps();
    const root = host.attachShadow({ mode: 'open' });
    const parent = document.createElement('div');
    // The style sheet of a shadow root may not be an inline style under the policy, but may be set
    // through the object model.
    const sheet = new CSSStyleSheet();
    sheet.replaceSync(':host { display: block } div:first-child { height: 100% }');
    root.adoptedStyleSheets.push(sheet);
    root.append(parent);
    this.#view = new EditorView({
      parent,
      root,
      state: EditorState.create({
        doc: text,
        extensions: [
          lineNumbers,
          highlightSpecialChars(),
          history({ newGroupDelay: Infinity, joinToEvent: steps.join }),
          drawSelection(),
          indentOnInput(),
          bracketMatching(),
          highlightActiveLine(),
          // An author who closes an element by hand gets no second end tag.
          xml({ autoCloseTags: false }),
          syntaxHighlighting(colours),
          lintGutter(),
          EditorView.lineWrapping,
          EditorView.domEventHandlers({ beforeinput: typedOver }),
          EditorView.contentAttributes.of({ 'aria-label': label, tabindex: '0', spellcheck: 'false', autocapitalize: 'off' }),
          keymap.of([...defaultKeymap, ...historyKeymap]),
          look,
          EditorView.updateListener.of((update) => {
            for (const transaction of update.transactions) steps.note(transaction);
            if (update.docChanged) events.text(update.state.doc.toString());
            if (update.docChanged || update.transactions.length > 0) events.moved();
          }),
        ],
      }),
    });
  }

  get text(): string {
    return this.#view.state.doc.toString();
  }

  get canUndo(): boolean {
    return undoDepth(this.#view.state) > 0;
  }

  get canRedo(): boolean {
    return redoDepth(this.#view.state) > 0;
  }

  undo(): void {
    this.settle();
    undo(this.#view);
  }

  redo(): void {
    this.settle();
    redo(this.#view);
  }

  /** Changes the text in one step. */
  change(changes: readonly Change[]): void {
    this.settle();
    this.#dispatch(changes, false);
  }

  /** Changes the text for a control that moves: all of it until `settle` is one step. */
  drag(changes: readonly Change[]): void {
    if (changes.length === 0) return;
    this.#dispatch(changes, this.#moving);
    this.#moving = true;
  }

  /** Ends the movement of a control. */
  settle(): void {
    this.#moving = false;
  }

  #dispatch(changes: readonly Change[], on: boolean): void {
    if (changes.length > 0) this.#view.dispatch({ changes: [...changes], annotations: goesOn.of(on) });
  }

  /** Marks problems at their positions. */
  show(diagnostics: readonly Diagnostic[]): void {
    const marks = diagnostics.flatMap(({ start, end, severity, message, hints }): Mark[] => {
      if (start === undefined) return [];
      const from = this.#at(start);
      const to = Math.max(from, end === undefined ? from : this.#at(end));
      return [{ from, to, severity, message: [message, ...hints].join('\n') }];
    });
    this.#view.dispatch(setDiagnostics(this.#view.state, marks));
  }

  #at({ line, columnUtf16 }: Place): number {
    const { doc } = this.#view.state;
    const found = doc.line(Math.min(doc.lines, Math.max(1, line)));
    return Math.min(found.to, found.from + columnUtf16 - 1);
  }

  /** Moves the cursor to a position and scrolls it into view. */
  goTo(place: Place): void {
    const at = this.#at(place);
    this.#view.dispatch({ selection: { anchor: at }, effects: EditorView.scrollIntoView(at, { y: 'center' }) });
    this.#view.focus();
  }

  /** Scrolls a position of the text into view within the editor; page scroll and focus do not change. */
  reveal(at: number): void {
    const { scrollDOM } = this.#view;
    const { top, bottom } = this.#view.lineBlockAt(Math.min(at, this.#view.state.doc.length));
    const { scrollTop, clientHeight } = scrollDOM;
    if (top >= scrollTop && bottom <= scrollTop + clientHeight) return;
    // The line on top is whole.
    scrollDOM.scrollTop = this.#view.lineBlockAtHeight(Math.max(0, top - clientHeight / 3)).top;
  }
}
