// A program as text: coloured, with completion while it is written, and errors underlined.
import { EditorView, highlightActiveLine, lineNumbers } from "@codemirror/view";
import { useEffect, useRef } from "react";
import type { Mark } from "../wire";
import { editorExtensions, useEditor } from "./editor";
import css from "./text.module.css";

interface ProgramTextProps {
  text: string;
  onChange: (text: string) => void;
  marks: readonly Mark[];
}

export function ProgramText({ text, onChange, marks }: ProgramTextProps) {
  const changed = useRef(onChange);
  useEffect(() => {
    changed.current = onChange;
  });
  const listener = EditorView.updateListener.of((update) => {
    if (update.docChanged) changed.current(update.state.doc.toString());
  });
  const box = useEditor(text, marks, () => [editorExtensions(false, "Program"), listener, lineNumbers(), highlightActiveLine()]);
  return <div ref={box} className={css.program} data-testid="program-text" />;
}
