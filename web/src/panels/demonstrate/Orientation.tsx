// Which way is up on every asset: set by landmarks, which are clicked, or written as text.
import { Crosshair, Pencil, X } from "lucide-react";
import { type FormEvent, useEffect, useState } from "react";
import { startLandmarks } from "../../commands/demonstrate";
import { perform } from "../../store/edits";
import {
  type Directive,
  directiveText,
  pairFromClicks,
  parseDirective,
  withoutPair,
  withPair,
} from "../../store/orientation";
import { useProject } from "../../store/project";
import { useAssetView, useScenes } from "../../store/scenes";
import { reportProblem } from "../../store/toasts";
import { setTool, useWorkspace } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { Check } from "../../ui/fields";
import { Note, Section } from "../../ui/Section";
import { DirectionField } from "./ArgumentField";
import css from "./demonstrate.module.css";

export function Orientation() {
  const text = useProject((state) => state.project.orient);
  const sentence = useProject((state) => state.project.orient_sentence);
  const unturned = useAssetView()?.unturned;
  const [writing, setWriting] = useState(false);
  const directive = parseDirective(text);
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
        directive && (
          <>
            <Pairs directive={directive} />
            <LandmarkClicks directive={directive} />
          </>
        )
      )}
    </Section>
  );
}

function Pairs({ directive }: { directive: Directive }) {
  if (!directive.pairs.length) return null;
  return (
    <>
      <ul className={css.pairs}>
        {directive.pairs.map((pair, k) => (
          <li key={pair.direction}>
            <strong>{pair.direction.replace("-", "−")}</strong>
            <span className={css.code}>
              {pair.from} → {pair.to}
            </span>
            <IconButton
              icon={X}
              name={`Remove ${pair.direction}`}
              onClick={() => orient(withoutPair(directive, k))}
            />
          </li>
        ))}
      </ul>
      <Check checked={directive.snap} onChange={(snap) => orient({ ...directive, snap })}>
        Quarter turns only
      </Check>
    </>
  );
}

function orient(directive: Directive): void {
  void perform({ kind: "orient", text: directiveText(directive) });
}

/** A direction from two clicked hulls: it points from the landmark of the first to that of the second. */
function LandmarkClicks({ directive }: { directive: Directive }) {
  const clicking = useWorkspace((workspace) => workspace.tool === "landmark");
  const [direction, setDirection] = useState("+Z");
  if (!clicking) {
    return (
      <Button
        icon={Crosshair}
        onClick={startLandmarks}
        tip="Click a hull where the direction starts and one where it ends"
      >
        {directive.pairs.length ? "Set another by clicking" : "Set by clicking"}
      </Button>
    );
  }
  return <ClickForm directive={directive} direction={direction} setDirection={setDirection} />;
}

interface ClickFormProps {
  directive: Directive;
  direction: string;
  setDirection: (direction: string) => void;
}

function ClickForm({ directive, direction, setDirection }: ClickFormProps) {
  const first = useWorkspace((workspace) => workspace.landmarks[0]);
  useEffect(
    () =>
      useWorkspace.subscribe(({ landmarks: [start, end] }) => {
        if (start === undefined || end === undefined) return;
        take(directive, direction, start, end);
      }),
    [directive, direction],
  );
  return (
    <div className={css.clicking}>
      <DirectionField value={direction} onChange={setDirection} />
      <Note>
        {first === undefined ? (
          <>
            <strong>1.</strong> Click a hull where {direction.replace("-", "−")} starts, as a leg for up.
          </>
        ) : (
          <>
            Starts at <strong>{labelOf(first) ?? first}</strong>. <strong>2.</strong> Click a hull that it points to.
          </>
        )}
      </Note>
      <Button onClick={() => setTool("select")}>Cancel</Button>
    </div>
  );
}

/** Makes the directive of two clicked hulls; where they cannot be landmarks, clicking begins anew. */
function take(directive: Directive, direction: string, start: string, end: string): void {
  const pair = pairFromClicks(direction, labelOf(start), labelOf(end));
  if (typeof pair === "string") {
    setTool("landmark");
    return reportProblem({ message: pair, where: null, remedy: null, conflict: false });
  }
  setTool("select");
  void perform({ kind: "orient", text: directiveText(withPair(directive, pair)) });
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
