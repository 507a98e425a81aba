// Pictures of what was measured, drawn when they are wanted.
import { LoaderCircle } from "lucide-react";
import { useEffect, useState } from "react";
import { api } from "../../../server/api";
import { ServerProblem } from "../../../server/http";
import { type Part, usePictured, showPictures } from "../../../store/checks";
import { sentence } from "../../../store/words";
import type { CheckPicture, Problem } from "../../../wire";
import { Button } from "../../../ui/Button";
import { Note } from "../../../ui/Section";
import css from "./checks.module.css";
import { Enlarged } from "./Enlarged";

interface Of {
  asset: string;
  version: string;
  part: Part;
}

export function CheckPictures(of: Of) {
  const on = usePictured(of.part);
  return (
    <div className={css.pictures}>
      <Button look="quiet" aria-expanded={on} onClick={() => showPictures(of.part, !on)}>
        {on ? "Hide the pictures" : of.part === "fit" ? "Show where" : "Show what space"}
      </Button>
      {on && <Pictures {...of} />}
    </div>
  );
}

type Drawn = { kind: "coming" } | { kind: "there"; pictures: readonly CheckPicture[] } | { kind: "problem"; problem: Problem };

function Pictures({ asset, version, part }: Of) {
  const drawn = useDrawn(asset, version, part);
  if (drawn.kind === "problem") return <Note mood="bad">{drawn.problem.message}</Note>;
  if (drawn.kind === "coming") {
    return (
      <p className={css.coming} role="status">
        <LoaderCircle size={14} aria-hidden className={css.spinning} /> drawing
      </p>
    );
  }
  if (!drawn.pictures.length) return <p className={css.dim}>There is nothing to be drawn.</p>;
  return drawn.pictures.map(({ name, text }) => (
    <figure key={name}>
      <Enlarged source={api.checkPicture(asset, name, version)} text={sentence(text)} />
      <figcaption>{sentence(text)}</figcaption>
    </figure>
  ));
}

/** The pictures, drawn anew when the output changes; the drawing stops when nobody looks any more. */
function useDrawn(asset: string, version: string, part: Part): Drawn {
  const [drawn, setDrawn] = useState<Drawn>({ kind: "coming" });
  useEffect(() => {
    const stop = new AbortController();
    api.checkPictures(asset, part, stop.signal).then(
      (pictures) => setDrawn({ kind: "there", pictures }),
      (error: unknown) => {
        if (stop.signal.aborted) return;
        if (error instanceof ServerProblem) setDrawn({ kind: "problem", problem: error.problem });
        else throw error;
      },
    );
    return () => stop.abort();
  }, [asset, version, part]);
  return drawn;
}
