// A program as text: coloured, with completion while it is written, and errors underlined.
import { EditorState } from "@codemirror/state";
import { EditorView, highlightActiveLine, lineNumbers } from "@codemirror/view";
import { useEffect, useRef } from "react";
import type { Mark } from "../wire";
import { editorExtensions, useEditor, viewerExtensions } from "./editor";
import css from "./text.module.css";

interface ProgramTextProps {
  text: string;
  onChange?: (text: string) => void;
  marks: readonly Mark[];
  readOnly: boolean;
}

export function ProgramText({ text, onChange, marks, readOnly }: ProgramTextProps) {
  const changed = useRef(onChange);
  useEffect(() => {
    changed.current = onChange;
  }, [onChange]);
  const listener = EditorView.updateListener.of((update) => {
    if (update.docChanged) changed.current?.(update.state.doc.toString());
  });
  const box = useEditor(text, marks, () =>
    readOnly
      ? [viewerExtensions("Program"), EditorState.readOnly.of(true)]
      : [editorExtensions(false, "Program"), listener, lineNumbers(), highlightActiveLine()],
  );
  return <div ref={box} className={css.program} data-testid="program-text" />;
}
