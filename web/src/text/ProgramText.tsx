// A program as text: coloured, with completion while it is written, and errors underlined.
import { EditorView, highlightActiveLine, lineNumbers } from "@codemirror/view";
import type { Mark } from "../wire";
import { editorExtensions, useEditor } from "./editor";
import css from "./text.module.css";

interface ProgramTextProps {
  text: string;
  onChange: (text: string) => void;
  marks: readonly Mark[];
}

export function ProgramText({ text, onChange, marks }: ProgramTextProps) {
  const box = useEditor(text, marks, () => [
    editorExtensions(false, "Program"),
    EditorView.updateListener.of(({ docChanged, state }) => docChanged && onChange(state.doc.toString())),
    lineNumbers(),
    highlightActiveLine(),
  ]);
  return <div ref={box} className={css.program} data-testid="program-text" />;
}
