// Pictures of what was measured, drawn when they are wanted.
import { LoaderCircle, X } from "lucide-react";
import { Dialog } from "radix-ui";
import { useEffect, useState } from "react";
import { api } from "../../server/api";
import { getBlob, problemOf, ServerProblem } from "../../server/http";
import { type Part, showPictures, useShowsPictures } from "../../store/checks";
import { textIn } from "../../store/units";
import { toSentence } from "../../store/words";
import { useUnit } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { useAnswer } from "../../ui/useAnswer";
import css from "./checks.module.css";

interface PartId {
  asset: string;
  part: Part;
}

export function CheckPictures(of: PartId) {
  const on = useShowsPictures(of.part);
  return (
    <div className={css.pictures}>
      <Button look="quiet" aria-expanded={on} onClick={() => showPictures(of.part, !on)}>
        {on ? "Hide the pictures" : of.part === "fit" ? "Show where" : "Show the space"}
      </Button>
      {on && <Pictures {...of} />}
    </div>
  );
}

export function Coming({ what }: { what: string }) {
  return (
    <p className={css.coming} role="status">
      <LoaderCircle size={14} aria-hidden className={css.spinning} /> {what}
    </p>
  );
}

/** Drawn anew when the unit changes; the drawing stops when nobody looks any more. */
function Pictures({ asset, part }: PartId) {
  const unit = useUnit();
  const drawn = useAnswer(`${asset} ${part} ${unit}`, (stop) => api.checkPictures(asset, part, unit, stop).catch(problemOf));
  if (drawn instanceof ServerProblem) return <Note mood="bad">{drawn.problem.message}</Note>;
  if (!drawn) return <Coming what="drawing" />;
  if (!drawn.length) return <p className={css.dim}>There is nothing to draw.</p>;
  return drawn.map(({ text, source }) => {
    const words = toSentence(textIn(text, unit));
    return (
      <figure key={text}>
        <EnlargeablePicture source={source} text={words} />
        <figcaption>{words}</figcaption>
      </figure>
    );
  });
}

/** Not the button in it, whose hint would take the first Escape. */
function focusWhole(event: Event): void {
  event.preventDefault();
  if (event.currentTarget instanceof HTMLElement) event.currentTarget.focus();
}

/** A picture as an address that an image can show, undefined until it is there. */
function useFetched(source: string): string | undefined {
  const [shown, setShown] = useState<string>();
  const isWhole = source.startsWith("data:");
  useEffect(() => {
    if (isWhole) return;
    let made: string | undefined;
    let wanted = true;
    void getBlob(source).then((picture) => {
      if (wanted) setShown((made = URL.createObjectURL(picture)));
    });
    return () => {
      wanted = false;
      if (made !== undefined) URL.revokeObjectURL(made);
    };
  }, [source, isWhole]);
  return isWhole ? source : shown;
}

/** A picture that a click shows large, over everything else. */
export function EnlargeablePicture({ source, text }: { source: string; text: string }) {
  const shown = useFetched(source);
  return (
    <Dialog.Root>
      <Dialog.Trigger className={css.small} title="Enlarge">
        <img src={shown} alt={text} />
      </Dialog.Trigger>
      <Dialog.Portal>
        <Dialog.Overlay className={css.shade} />
        <Dialog.Content className={css.large} aria-describedby={undefined} onOpenAutoFocus={focusWhole}>
          <header>
            <Dialog.Title>{text}</Dialog.Title>
            <Dialog.Close asChild>
              <IconButton icon={X} name="Close" />
            </Dialog.Close>
          </header>
          <img src={shown} alt="" />
        </Dialog.Content>
      </Dialog.Portal>
    </Dialog.Root>
  );
}
