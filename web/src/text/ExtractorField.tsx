// A line to select by an extractor: shows at once what it selects here and on the family, and takes it on Enter.
import { EditorState, Prec } from "@codemirror/state";
import { EditorView, keymap, placeholder } from "@codemirror/view";
import { Popover } from "radix-ui";
import { useEffect, useMemo, useState } from "react";
import { left, takeFound, typed, useExtracting } from "../store/extracting";
import { askLanguage } from "../store/language";
import { spreadText } from "../store/lessons";
import { readable, useProject } from "../store/project";
import { Button } from "../ui/Button";
import { counted } from "../store/words";
import { editing } from "./editing";
import { oneLine } from "./looks";
import css from "./text.module.css";
import { useEditor } from "./useEditor";

export function ExtractorField() {
  const [focused, setFocused] = useState(false);
  const text = useExtracting((state) => state.text);
  const mark = useExtracting((state) => state.found?.mark ?? null);
  const marks = useMemo(() => (mark && text ? [mark] : []), [mark, text]);
  useEffect(askLanguage, []);
  const box = useEditor(text, marks, () => [
    Prec.high(
      keymap.of([
        { key: "Enter", run: taken },
        { key: "Escape", run: blurred },
      ]),
    ),
    editing(true, "Select by a rule"),
    single,
    oneLine,
    placeholder("Select by a rule: Is(…), Geo(…)"),
    EditorView.updateListener.of((update) => {
      if (update.docChanged) typed(update.state.doc.toString());
      if (!update.focusChanged) return;
      setFocused(update.view.hasFocus);
      if (!update.view.hasFocus) left();
      else if (update.state.doc.length) typed(update.state.doc.toString());
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
          <Found />
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}

/** What the text selects in words, or what is wrong with it. */
function Found() {
  const found = useExtracting((state) => state.found);
  const family = useExtracting((state) => state.family);
  const assets = useProject((state) => readable(state.cards));
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
          <strong>{counted(found.select.length, "hull")}</strong> here
          {family && `; in the family ${spreadText(family, assets)}`}
        </span>
        <Button
          look="primary"
          disabled={!found.select.length}
          onClick={() => void takeFound()}
          tip="Select these hulls"
          keys="Enter"
        >
          Select
        </Button>
      </div>
    </>
  );
}

const single = [
  EditorState.transactionFilter.of((change) => (change.newDoc.lines > 1 ? [] : change)),
  EditorView.clipboardInputFilter.of((pasted) => pasted.replaceAll(/\s*\n\s*/g, " ")),
];

function taken(view: EditorView): boolean {
  void takeFound().then((done) => done && view.contentDOM.blur());
  return true;
}

function blurred(view: EditorView): boolean {
  view.contentDOM.blur();
  return true;
}
