// One reading of a rule: what it says, how believable it is, and where it does something else.
import { meanReading } from "../../commands/learning";
import { visit } from "../../store/desk";
import { counted, shortName } from "../../store/words";
import type { ReadingView } from "../../wire";
import { Button } from "../../ui/Button";
import css from "./learn.module.css";
import { RuleText } from "./RuleText";
import { useGeneralised } from "./useGeneralised";

export function ReadingRow({ reading, own }: { reading: ReadingView; own: boolean }) {
  const { rule, extractor, sentence, belief, size, differs_on: differs } = reading;
  const point = useGeneralised(extractor, rule);
  const percent = Math.round(100 * belief);
  return (
    <li className={css.reading} data-own={own} onPointerEnter={point.on} onPointerLeave={point.off} onFocus={point.on} onBlur={point.off}>
      <RuleText text={extractor} />
      <span className={css.sentence}>{sentence}</span>
      <span className={css.belief} title="How believable it is, and of how many parts it is made: shorter ones are more believable">
        <span className={css.bar} aria-hidden>
          <span style={{ width: `${percent}%` }} />
        </span>
        {percent < 1 ? "< 1" : percent} % · {counted(size, "part")}
      </span>
      {own ? <span className={css.facts}>in the program</span> : <Elsewhere assets={differs} />}
      {!own && differs.length > 0 && (
        <Button tip="Answers for the assets that tell this reading from the others" onClick={() => void meanReading(reading)}>
          Mean this one
        </Button>
      )}
    </li>
  );
}

/** The assets on which a reading selects something else than the program's. */
function Elsewhere({ assets }: { assets: readonly string[] }) {
  if (!assets.length) return <span className={css.facts}>does the same on all your assets</span>;
  return (
    <span className={css.facts}>
      differs on{" "}
      {assets.slice(0, 4).map((asset) => (
        <button key={asset} type="button" className={css.link} title={`Open ${asset}`} onClick={() => visit(asset, { kind: "source" })}>
          {shortName(asset)}
        </button>
      ))}
      {assets.length > 4 && <span>and {assets.length - 4} more</span>}
    </span>
  );
}
