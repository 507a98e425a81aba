// The CodeMirror editor of program text: colours, completion, brackets, errors underlined; in React made once, its text
// kept in step.
import {
  autocompletion,
  closeBrackets,
  closeBracketsKeymap,
  type Completion,
  type CompletionContext,
  type CompletionResult,
  insertBracket,
  startCompletion,
} from "@codemirror/autocomplete";
import { defaultKeymap, history, historyKeymap } from "@codemirror/commands";
import { bracketMatching } from "@codemirror/language";
import { type Diagnostic, setDiagnostics } from "@codemirror/lint";
import { EditorState, type Extension, type Text } from "@codemirror/state";
import { Decoration, type DecorationSet, drawSelection, EditorView, keymap, tooltips, ViewPlugin, type ViewUpdate } from "@codemirror/view";
import { type RefObject, useEffect, useRef } from "react";
import { useProject } from "../store/project";
import type { Mark } from "../wire";
import { type Suggestion, suggestions, wordBefore } from "./completion";
import { theme } from "./theme";
import { piecesOf } from "./tokens";

/** Editing program text, or, where `bare`, an extractor alone. */
export function editorExtensions(bare: boolean, name: string): Extension {
  return [
    history(),
    drawSelection(),
    bracketMatching(),
    tooltips({ position: "fixed", parent: document.body }),
    closeBrackets(),
    EditorState.languageData.of(() => [{ closeBrackets: { brackets: ["(", '"'] } }]),
    autocompletion({ override: [(context) => complete(context, bare)], icons: false }),
    keymap.of([...closeBracketsKeymap, ...historyKeymap, ...defaultKeymap]),
    syntaxColors,
    theme,
    EditorView.contentAttributes.of({ "aria-label": name, spellcheck: "false" }),
  ];
}

/** What may be put where one types; null where nothing is to be offered. */
export function complete(context: CompletionContext, bare: boolean): CompletionResult | null {
  const line = context.state.doc.lineAt(context.pos);
  const before = line.text.slice(0, context.pos - line.from);
  const word = wordBefore(before);
  if ((!word && !context.explicit && !/[(,]\s*$|=>\s*$/.test(before))) return null;
  const { language, project } = useProject.getState();
  const labels = project.vocabulary.map(({ text }) => text);
  const options = suggestions(before, { language, labels, templates: project.templates }, bare);
  const done = (text: string) => options.some(({ label, call }) => label === text && !call);
  if (!options.length || done(word)) return null;
  const going = (text: string) => /^(?:"[^"]*"?|[+-]?[\p{L}\p{N}_]*)$/u.test(text) && !done(text);
  return { from: context.pos - word.length, options: options.map(toCompletion), validFor: going };
}

function toCompletion({ call, ...rest }: Suggestion): Completion {
  return call ? { ...rest, apply: insertCall } : rest;
}

/** Puts a call there, with its brackets, and goes on inside of them. */
function insertCall(view: EditorView, { label }: Completion, from: number, to: number): void {
  view.dispatch({ changes: { from, to, insert: label }, selection: { anchor: from + label.length } });
  view.dispatch(insertBracket(view.state, "(") ?? view.state.replaceSelection("("));
  startCompletion(view);
}

/** Underlines from each mark to the end of its word. */
function underline(view: EditorView, marks: readonly Mark[]): void {
  view.dispatch(
    setDiagnostics(
      view.state,
      marks.map((mark) => diagnostic(view.state.doc, mark)),
    ),
  );
}

/** A mark as the editor underlines it: to the end of its word, or the sign before it at the end of a line. */
export function diagnostic(doc: Text, { line, column, message }: Mark): Diagnostic {
  const row = doc.line(Math.min(Math.max(line, 1), doc.lines));
  const at = Math.min(Math.max(column - 1, 0), row.length);
  const word = /^(?:"[^"]*"?|[\p{L}\p{N}_]+|\S)/u.exec(row.text.slice(at))?.[0].length ?? 0;
  const from = word ? row.from + at : Math.max(row.from, row.from + at - 1);
  return { from, to: Math.max(row.from + at + word, from), severity: "error", message };
}

/** Colours program text in an editor, line by line as lines come into view; labels are underlined in their colour. */
const syntaxColors: Extension = ViewPlugin.fromClass(
  class {
    decorations: DecorationSet;

    constructor(view: EditorView) {
      this.decorations = decorate(view);
    }

    update(update: ViewUpdate): void {
      if (update.docChanged || update.viewportChanged) this.decorations = decorate(update.view);
    }
  },
  { decorations: (plugin) => plugin.decorations },
);

function decorate(view: EditorView): DecorationSet {
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

/** The element to mount the editor in; extensions are those of the first time. */
export function useEditor(
  text: string,
  marks: readonly Mark[],
  extensions: () => Extension,
): RefObject<HTMLDivElement | null> {
  const box = useRef<HTMLDivElement>(null);
  const editor = useRef<EditorView>(null);
  const first = useRef({ text, extensions });
  useEffect(() => {
    if (!box.current) return;
    const { text: doc, extensions: given } = first.current;
    const view = new EditorView({ state: EditorState.create({ doc, extensions: given() }), parent: box.current });
    editor.current = view;
    return () => view.destroy();
  }, []);
  useEffect(() => {
    const view = editor.current;
    if (view && view.state.doc.toString() !== text)
      view.dispatch({ changes: { from: 0, to: view.state.doc.length, insert: text } });
  }, [text]);
  useEffect(() => {
    if (editor.current) underline(editor.current, marks);
  }, [marks]);
  return box;
}
