// Why there is no program, what came nearest, and what would help.
import { Crosshair, RotateCw } from "lucide-react";
import { orientBy, showNearest } from "../../commands/learning";
import { counted, listed, shortName } from "../../store/words";
import type { LessonView, NearestView } from "../../wire";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import css from "./learn.module.css";
import { RuleText } from "./RuleText";

export function NoProgram({ lesson }: { lesson: LessonView }) {
  const { nearest, advice, suggested_orientation: orient } = lesson;
  if (!nearest && !advice.length && !orient) return null;
  return (
    <Section title="What would help">
      {nearest && <Nearest nearest={nearest} />}
      {advice.length > 0 && (
        <ul className={css.advice}>
          {advice.map((line) => (
            <li key={line}>{line}</li>
          ))}
        </ul>
      )}
      {orient && (
        <div className={css.split}>
          <p>
            With another orientation every rule can be told: <code className={css.code}>{orient}</code>
          </p>
          <Button icon={RotateCw} onClick={() => void orientBy(orient)}>
            Use it
          </Button>
        </div>
      )}
    </Section>
  );
}

function Nearest({ nearest }: { nearest: NearestView }) {
  const { rule, extractor, asset, extra, missing } = nearest;
  return (
    <div className={css.nearest}>
      <p>
        Nearest for rule {rule}: <RuleText text={extractor} />
      </p>
      <p>
        On <span title={asset}>{shortName(asset)}</span> it
      </p>
      <Difference nearest={nearest} names={extra} what="takes too much" />
      <Difference nearest={nearest} names={missing} what="leaves out" />
    </div>
  );
}

function Difference({ nearest, names, what }: { nearest: NearestView; names: readonly string[]; what: string }) {
  if (!names.length) return null;
  return (
    <div className={css.split}>
      <p>
        {what} {counted(names.length, "hull")}: <span title={names.join(", ")}>{listed(names)}</span>
      </p>
      <Button
        look="quiet"
        icon={Crosshair}
        aria-label={`Show what it ${what} on ${nearest.asset}`}
        onClick={() => showNearest(nearest, names)}
      >
        Show
      </Button>
    </div>
  );
}
