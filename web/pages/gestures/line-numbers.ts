/**
 * Line numbers inside the lines. CodeMirror's own are in a gutter, at heights estimated while the editor is out of view: with wrapped lines, on a phone, they
 * drift from their lines.
 */

import { RangeSetBuilder, type Extension } from '@codemirror/state';
import { Decoration, type DecorationSet, EditorView, ViewPlugin } from '@codemirror/view';

/** Numbers the rendered lines. */
function numbered(view: EditorView): DecorationSet {
  const { doc } = view.state;
  const builder = new RangeSetBuilder<Decoration>();
  for (const { from, to } of view.visibleRanges) {
    for (let line = doc.lineAt(from); ; line = doc.line(line.number + 1)) {
      builder.add(line.from, line.from, Decoration.line({ attributes: { 'data-line': String(line.number) } }));
      if (line.to >= to || line.number === doc.lines) break;
    }
  }
  return builder.finish();
}

export const lineNumbers: Extension = [
  ViewPlugin.define(
    (view) => {
      const numbers = {
        decorations: numbered(view),
        update: ({ view: now, docChanged, viewportChanged }: { view: EditorView; docChanged: boolean; viewportChanged: boolean }) => {
          if (docChanged || viewportChanged) numbers.decorations = numbered(now);
        },
      };
      return numbers;
    },
    { decorations: (numbers) => numbers.decorations },
  ),
  EditorView.theme({
    '.cm-line': { position: 'relative', paddingLeft: '4.5ch' },
    // The empty text is the alternative for screen readers.
    '.cm-line::before': { content: 'attr(data-line) / ""', position: 'absolute', left: '0', width: '3ch', textAlign: 'end', color: '#9d8d9b' },
  }),
];
