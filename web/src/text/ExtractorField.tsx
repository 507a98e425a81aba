// A line to select by an extractor: shows at once what it selects here and on the family, and takes it on Enter.
import { EditorState, Prec } from "@codemirror/state";
import { EditorView, keymap, placeholder } from "@codemirror/view";
import { Popover } from "radix-ui";
import { useEffect, useMemo, useState } from "react";
import { leaveExtractor, selectFound, typeExtractor, useExtractor } from "../store/extractor";
import { coverageText } from "../store/outcome";
import { countReadable, useProject } from "../store/project";
import { countText } from "../store/words";
import { Button } from "../ui/Button";
import { editorExtensions, useEditor } from "./editor";
import { oneLine } from "./theme";
import css from "./text.module.css";

export function ExtractorField() {
  const [focused, setFocused] = useState(false);
  const text = useExtractor((state) => state.text);
  const mark = useExtractor((state) => state.found?.mark ?? null);
  const marks = useMemo(() => (mark && text ? [mark] : []), [mark, text]);
  useEffect(() => leaveExtractor, []);
  const box = useEditor(text, marks, () => [
    Prec.high(
      keymap.of([
        { key: "Enter", run: takeSelection },
        { key: "Escape", run: blur },
      ]),
    ),
    editorExtensions(true, "Select by a rule"),
    singleLine,
    oneLine,
    placeholder("Select by a rule…"),
    EditorView.updateListener.of((update) => {
      if (update.docChanged) typeExtractor(update.state.doc.toString());
      if (!update.focusChanged) return;
      setFocused(update.view.hasFocus);
      if (!update.view.hasFocus) leaveExtractor();
      else if (update.state.doc.length) typeExtractor(update.state.doc.toString());
    }),
  ]);
  return (
    <Popover.Root open={focused && text.trim() !== ""}>
      <Popover.Anchor asChild>
        <div ref={box} className={css.field} data-testid="extractor" />
      </Popover.Anchor>
      <Popover.Portal>
        <Popover.Content
          className={css.found}
          align="start"
          sideOffset={6}
          data-modeless
          onOpenAutoFocus={(event) => event.preventDefault()}
          onCloseAutoFocus={(event) => event.preventDefault()}
          onPointerDown={(event) => event.preventDefault()}
        >
          <Answer />
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}

/** What the text selects in words, or what is wrong with it. */
function Answer() {
  const found = useExtractor((state) => state.found);
  const family = useExtractor((state) => state.family);
  const assets = useProject((state) => countReadable(state.cards));
  if (!found) return <p role="status">Looking…</p>;
  if (found.mark)
    return (
      <p role="status" className={css.wrong}>
        {found.mark.message}
      </p>
    );
  return (
    <>
      <p role="status">{found.sentence}</p>
      <div className={css.use}>
        <span>
          <strong>{countText(found.select.length, "hull")}</strong> here
          {family && `; in the family ${coverageText(family, assets)}`}
        </span>
        <Button look="primary" disabled={!found.select.length} onClick={() => void selectFound()} tip="Select these hulls" keys="Enter">
          Select
        </Button>
      </div>
    </>
  );
}

const singleLine = [
  EditorState.transactionFilter.of((change) => (change.newDoc.lines > 1 ? [] : change)),
  EditorView.clipboardInputFilter.of((pasted) => pasted.replaceAll(/\s*\n\s*/g, " ")),
];

function takeSelection(view: EditorView): boolean {
  void selectFound().then((done) => done && view.contentDOM.blur());
  return true;
}

function blur(view: EditorView): boolean {
  view.contentDOM.blur();
  return true;
}
