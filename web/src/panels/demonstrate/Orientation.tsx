// Which way is up on every asset: told by landmarks, which are clicked, or written as text.
import { Pencil, X } from "lucide-react";
import { useState } from "react";
import { perform } from "../../store/edits";
import { useAssetView } from "../../store/hooks";
import { type Directive, directiveOf, directiveText, withoutPair } from "../../store/orientation";
import { useProject } from "../../store/project";
import { IconButton } from "../../ui/Button";
import { Check } from "../../ui/Check";
import { Note, Section } from "../../ui/Section";
import css from "./demonstrate.module.css";
import { LandmarkClicks } from "./LandmarkClicks";
import { OrientationText } from "./OrientationText";

export function Orientation() {
  const text = useProject((state) => state.project.orient);
  const sentence = useProject((state) => state.project.orient_sentence);
  const unturned = useAssetView()?.unturned;
  const [writing, setWriting] = useState(false);
  const directive = directiveOf(text);
  const edit = <IconButton icon={Pencil} name="Write it as text" on={writing} onClick={() => setWriting(!writing)} />;
  return (
    <Section title="Orientation" aside={edit}>
      <p className={text ? undefined : css.hint}>
        {sentence || "Directions are those of the files. If assets lie in different ways, tell which way is up:"}
      </p>
      {unturned && <Note mood="warn">This asset cannot be turned: {unturned}</Note>}
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
              name={`Take ${pair.direction} away`}
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
