// Which asset is best demonstrated next.
import { ArrowRight } from "lucide-react";
import { demonstrate } from "../../commands/learning";
import { shortName } from "../../store/words";
import type { HintView } from "../../wire";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import css from "./learn.module.css";

export function Hint({ hint }: { hint: HintView }) {
  return (
    <Section title="To be surer">
      <div className={css.split}>
        <p>
          Best to demonstrate next: <strong title={hint.asset}>{shortName(hint.asset)}</strong>
          <span className={css.dim}> ({hint.why})</span>
        </p>
        <Button icon={ArrowRight} aria-label={`Demonstrate ${hint.asset}`} onClick={() => demonstrate(hint.asset)}>
          Go
        </Button>
      </div>
    </Section>
  );
}
