// What MeshForge does, in a sentence and a picture, and the guided tour.
import { ArrowRight, Play } from "lucide-react";
import { useState } from "react";
import { takeTour, useStart } from "../store/start";
import { Button } from "../ui/Button";
import after from "./pictures/after.png";
import before from "./pictures/before.png";
import { ProblemNote } from "./ProblemNote";
import css from "./start.module.css";

export function Intro() {
  const offer = useStart((state) => state.view?.tour ?? "");
  const busy = useStart((state) => state.busy !== null);
  const [typed, setTyped] = useState<string | null>(null);
  const folder = typed ?? offer;
  return (
    <section className={css.intro} aria-label="What MeshForge does">
      <div className={css.words}>
        <p className={css.lead}>Edit one collision mesh, and MeshForge learns the edit, fixes the whole family, and says how sure each result is.</p>
        <form
          className={css.form}
          onSubmit={(event) => {
            event.preventDefault();
            void takeTour(folder);
          }}
        >
          <div>
            <Button look="primary" type="submit" icon={Play} disabled={busy || !folder.trim()}>
              Take the guided tour
            </Button>
          </div>
          <label className={css.tourRow}>
            <span>Five minutes on 14 tables, in the new folder</span>
            <input className={css.field} aria-label="Folder of the tour" value={folder} spellCheck={false} autoComplete="off" onChange={(event) => setTyped(event.target.value)} />
          </label>
          <ProblemNote place="tour" />
        </form>
      </div>
      <figure className={css.figure}>
        <span>
          <img src={before} alt="A table in many pieces" />
          36 hulls, as CoACD cut it
        </span>
        <ArrowRight size={20} aria-hidden />
        <span>
          <img src={after} alt="The same table: one top, four legs, a drawer that is open" />
          21 hulls, by five rules
        </span>
      </figure>
    </section>
  );
}
