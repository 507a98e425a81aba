// What all editors of program text have: colours, completion, brackets, and errors underlined.
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
import { drawSelection, EditorView, keymap, tooltips } from "@codemirror/view";
import { useLanguage } from "../store/language";
import { useProject } from "../store/project";
import { labelText } from "../store/steps";
import type { Mark } from "../wire";
import { coloured } from "./coloured";
import { begun, type Suggestion, suggestions } from "./completion";
import { looks } from "./looks";

/** Editing program text, or, where `bare`, an extractor alone. */
export function editing(bare: boolean, name: string): Extension {
  return [
    history(),
    drawSelection(),
    bracketMatching(),
    tooltips({ position: "fixed", parent: document.body }),
    closeBrackets(),
    EditorState.languageData.of(() => [{ closeBrackets: { brackets: ["(", '"'] } }]),
    autocompletion({ override: [(context) => completed(context, bare)], icons: false }),
    keymap.of([...closeBracketsKeymap, ...historyKeymap, ...defaultKeymap]),
    reading(name),
  ];
}

/** Program text as it is shown, also where it cannot be changed. */
export function reading(name: string): Extension {
  return [coloured, looks, EditorView.contentAttributes.of({ "aria-label": name, spellcheck: "false" })];
}

function completed(context: CompletionContext, bare: boolean): CompletionResult | null {
  const { language } = useLanguage.getState();
  const line = context.state.doc.lineAt(context.pos);
  const before = line.text.slice(0, context.pos - line.from);
  const word = begun(before);
  if (!language || (!word && !context.explicit && !/[(,]\s*$|=>\s*$/.test(before))) return null;
  const { vocabulary, templates } = useProject.getState().project;
  const labels = vocabulary.map((label) => label.name);
  const options = suggestions(before, { language, labels, templates, written: labelText }, bare);
  const done = (text: string) => options.some(({ label, call }) => label === text && !call);
  if (!options.length || done(word)) return null;
  const going = (text: string) => /^(?:"[^"]*"?|[+-]?[\p{L}\p{N}_]*)$/u.test(text) && !done(text);
  return { from: context.pos - word.length, options: options.map(completion), validFor: going };
}

function completion({ call, ...rest }: Suggestion): Completion {
  return call ? { ...rest, apply: called } : rest;
}

/** Puts a call there, with its brackets, and goes on inside of them. */
function called(view: EditorView, { label }: Completion, from: number, to: number): void {
  view.dispatch({ changes: { from, to, insert: label }, selection: { anchor: from + label.length } });
  view.dispatch(insertBracket(view.state, "(") ?? view.state.replaceSelection("("));
  startCompletion(view);
}

/** Underlines from each mark to the end of its word. */
export function underline(view: EditorView, marks: readonly Mark[]): void {
  view.dispatch(
    setDiagnostics(
      view.state,
      marks.map((mark) => diagnostic(view.state.doc, mark)),
    ),
  );
}

export function diagnostic(doc: Text, { line, column, message }: Mark): Diagnostic {
  const row = doc.line(Math.min(Math.max(line, 1), doc.lines));
  const at = Math.min(Math.max(column - 1, 0), row.length);
  const word = /^(?:"[^"]*"?|[\p{L}\p{N}_]+|\S)/u.exec(row.text.slice(at))?.[0].length ?? 0;
  const from = word ? row.from + at : Math.max(row.from, row.from + at - 1);
  return { from, to: Math.max(row.from + at + word, from), severity: "error", message };
}
