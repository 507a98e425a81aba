// Colours program text in an editor, line by line as lines come into view; labels are underlined in their colour.
import type { Extension } from "@codemirror/state";
import { Decoration, type DecorationSet, EditorView, ViewPlugin, type ViewUpdate } from "@codemirror/view";
import { useProject } from "../store/project";
import { piecesOf } from "./lines";

export const coloured: Extension = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;

    constructor(view: EditorView) {
      this.decorations = decorated(view);
    }

    update(update: ViewUpdate): void {
      if (update.docChanged || update.viewportChanged) this.decorations = decorated(update.view);
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

function decorated(view: EditorView): DecorationSet {
  const colors = new Map(useProject.getState().project.vocabulary.map(({ name, color }) => [name, color]));
  const marks = view.visibleRanges.flatMap(({ from, to }) => {
    const first = view.state.doc.lineAt(from).number;
    const last = view.state.doc.lineAt(to).number;
    return Array.from({ length: last - first + 1 }, (_, k) => view.state.doc.line(first + k)).flatMap((line) =>
      piecesOf(line.text).map((piece) => {
        const color = piece.label === null ? undefined : colors.get(piece.label);
        const underlined = color ? { attributes: { style: `border-bottom: 2px solid ${color}` } } : {};
        return Decoration.mark({ class: `mf-${piece.kind}`, ...underlined }).range(
          line.from + piece.from,
          line.from + piece.to,
        );
      }),
    );
  });
  return Decoration.set(marks, true);
}
