// A CodeMirror editor in React: made once, its text kept in step with what it is given.
import { EditorState, type Extension } from "@codemirror/state";
import { EditorView } from "@codemirror/view";
import { type RefObject, useEffect, useRef } from "react";
import type { Mark } from "../wire";
import { underline } from "./editing";

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
