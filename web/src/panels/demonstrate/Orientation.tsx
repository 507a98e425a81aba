// Which way is up on every asset: set by landmarks, which are clicked, or written as text.
import { Crosshair, Pencil, X } from "lucide-react";
import { type FormEvent, useEffect, useEffectEvent, useState } from "react";
import { startLandmarks } from "../../commands/demonstrate";
import { perform } from "../../store/edits";
import { pairFromClicks, withoutPair, withPair } from "../../store/orientation";
import { useProject } from "../../store/project";
import { useAssetView, useScenes } from "../../store/scenes";
import { reportProblem } from "../../store/toasts";
import { setTool, useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Check } from "../../ui/fields";
import { Note, Section } from "../../ui/Section";
import type { OrientView } from "../../wire";
import { type Direction, DirectionField } from "./ArgumentField";
import css from "./demonstrate.module.css";

export function Orientation() {
  const orient = useProject((state) => state.project.orient);
  const { text, sentence } = orient;
  const unturned = useAssetView()?.unturned;
  const [writing, setWriting] = useState(false);
  const edit = <IconButton icon={Pencil} name="Write as text" on={writing} onClick={() => setWriting(!writing)} />;
  return (
    <Section title="Orientation" aside={edit}>
      <p className={text ? undefined : css.hint}>
        {sentence || "Directions are those of the files. If the assets lie in different directions, set which way is up:"}
      </p>
      {unturned && <Note mood="warn">This asset cannot be oriented: {unturned}</Note>}
      {writing ? (
        <OrientationText text={text} onDone={() => setWriting(false)} />
      ) : (
        <>
          <Pairs orient={orient} />
          <LandmarkClicks orient={orient} />
        </>
      )}
    </Section>
  );
}

function Pairs({ orient }: { orient: OrientView }) {
  if (!orient.pairs.length) return null;
  return (
    <>
      <ul className={css.pairs}>
        {orient.pairs.map(({ axis, start, end }, k) => (
          <li key={axis}>
            <strong>{axis.replace("-", "−")}</strong>
            <span className={css.code}>
              {start ?? "all"} → {end ?? "all"}
            </span>
            <IconButton icon={X} name={`Remove ${axis}`} onClick={() => setLandmarks(withoutPair(orient, k))} />
          </li>
        ))}
      </ul>
      <Check checked={orient.snap} onChange={(snap) => setLandmarks({ ...orient, snap })}>
        Quarter turns only
      </Check>
    </>
  );
}

function setLandmarks({ snap, pairs }: Pick<OrientView, "snap" | "pairs">): void {
  void perform({ kind: "landmarks", snap, pairs });
}

/** A direction from two clicked hulls: it points from the landmark of the first to that of the second; the view says what to click. */
function LandmarkClicks({ orient }: { orient: OrientView }) {
  const clicking = useWorkspace((workspace) => workspace.tool === "landmark");
  const [direction, setDirection] = useState<Direction>("+Z");
  const look = useEffectEvent(([start, end]: readonly string[]) => {
    if (start !== undefined && end !== undefined) take(orient, direction, start, end);
  });
  useEffect(() => useWorkspace.subscribe(({ landmarks }) => look(landmarks)), []);
  if (!clicking) {
    return (
      <Button icon={Crosshair} onClick={startLandmarks} tip="Click a hull where the direction starts and one where it ends">
        {orient.pairs.length ? "Set another by clicking" : "Set by clicking"}
      </Button>
    );
  }
  return (
    <div className={css.clicking}>
      <DirectionField value={direction} onChange={setDirection} />
      <Button onClick={() => setTool("select")}>Cancel</Button>
    </div>
  );
}

/** Sets the landmarks of two clicked hulls; where they cannot be landmarks, clicking begins anew. */
function take(orient: OrientView, direction: Direction, start: string, end: string): void {
  const pair = pairFromClicks(direction, labelOf(start), labelOf(end));
  if (typeof pair === "string") {
    setTool("landmark");
    return reportProblem({ message: pair, where: null, remedy: null, conflict: false });
  }
  setTool("select");
  setLandmarks(withPair(orient, pair));
}

function labelOf(name: string): string | null {
  return useScenes.getState().scene?.hulls.find((hull) => hull.name === name)?.label ?? null;
}

/** The orientation as text. */
function OrientationText({ text, onDone }: { text: string; onDone: () => void }) {
  const [typed, setTyped] = useState(text);
  const save = async (event: FormEvent) => {
    event.preventDefault();
    if (typed.trim() === text || (await perform({ kind: "orient", text: typed.trim() }))) onDone();
  };
  return (
    <form className={css.form} onSubmit={(event) => void save(event)}>
      <input
        autoFocus
        className={[css.input, css.code].join(" ")}
        aria-label="Orientation as text"
        placeholder="+Z: Is(leg) -> Is(panel)"
        value={typed}
        onChange={(event) => setTyped(event.target.value)}
        onKeyDown={(event) => {
          if (event.key !== "Escape") return;
          event.preventDefault();
          onDone();
        }}
      />
      <p className={css.hint}>Direction, colon, start -&gt; end; a second pair after a comma. Empty: no orientation.</p>
      <div className={css.buttons}>
        <Button look="primary" type="submit">
          Save
        </Button>
        <Button onClick={onDone}>Cancel</Button>
      </div>
    </form>
  );
}
