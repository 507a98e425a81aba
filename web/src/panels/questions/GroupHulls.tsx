// The hulls that a question is about, each in its place on its asset; exceptions get another label, or are left out.
import { Thumbnail } from "../../pictures/Thumbnail";
import { type Exceptions, placesOf } from "../../store/assessment";
import { commonPartsOf } from "../../store/commonParts";
import { useProject } from "../../store/project";
import { countText, listText } from "../../store/words";
import { visit } from "../../store/workspace";
import { Name } from "../../ui/Name";
import { Swatch } from "../../ui/Section";
import type { ReviewQuestionView } from "../../wire";
import { HullsPicture, useRulePicture } from "../learn/RulePicture";
import css from "./questions.module.css";

/** Assets whose pictures are drawn; the others are told in words. */
const MOST = 60;

/** Of so few, each is drawn from a side where the hulls are seen. */
const FEW = 12;

interface GroupHullsProps {
  question: ReviewQuestionView;
  exceptions: Exceptions;
  onChange: (exceptions: Exceptions) => void;
}

export function GroupHulls({ question, exceptions, onChange }: GroupHullsProps) {
  const { kind, hulls, choices } = question;
  const order = useProject((state) => state.order);
  const places = placesOf(question);
  const assets = Object.keys(places);
  const labels = choices.flatMap((choice) => choice.label ?? []);
  const canVary = kind === "group" && hulls.length > 1 && labels.length > 0;
  const vary = (asset: string) => onChange(nextException(exceptions, asset, labels));
  return (
    <ul className={css.group} data-few={assets.length < 3} aria-label={countText(hulls.length, "hull")} tabIndex={-1}>
      {assets.slice(0, MOST).map((asset) => {
        const names = hulls.filter((one) => one.asset === asset).map((one) => one.hull);
        const given = asset in exceptions ? (exceptions[asset] ?? null) : (labels[0] ?? null);
        return (
          <li key={asset} className={css.member} data-exception={asset in exceptions}>
            <button
              type="button"
              className={css.look}
              title={`${asset}: ${names.join(", ")}`}
              aria-label={`Open ${asset} with ${listText(names)} selected`}
              onClick={() => visit(asset, { kind: "source" }, names)}
            >
              {assets.length > FEW ? (
                <Thumbnail asset={asset} of="source" highlight={places[asset]} label="" />
              ) : (
                <InSight asset={asset} names={names} />
              )}
            </button>
            <span className={css.where} title={asset}>
              <Name text={asset} parts={commonPartsOf(order)(asset)} />
              {names.length > 1 && <b> ×{names.length}</b>}
            </span>
            {canVary && (
              <button type="button" className={css.label} onClick={() => vary(asset)} title="Another label, or left out">
                <span className="visually-hidden">{asset}: </span>
                <Label name={given} />
              </button>
            )}
          </li>
        );
      })}
      {assets.length > MOST && <li className={css.dim}>and {countText(assets.length - MOST, "more asset")}</li>}
    </ul>
  );
}

/** An asset from a side where the hulls in question are seen, or through what hides them. */
export function InSight({ asset, names }: { asset: string; names: readonly string[] }) {
  return <HullsPicture picture={useRulePicture(asset, 1, names)} hulls={names} label="" />;
}

function Label({ name }: { name: string | null }) {
  const color = useProject((state) => state.project.vocabulary.find((label) => label.name === name)?.color);
  if (name === null) return <>left out</>;
  return (
    <>
      <Swatch color={color ?? "var(--hull-unlabelled)"} />
      {name}
    </>
  );
}

/** From one label of a question to the next, then left out, then as the others again. */
export function nextException(exceptions: Exceptions, asset: string, labels: readonly string[]): Exceptions {
  const { [asset]: now, ...others } = exceptions;
  const row = [...labels.slice(1), null];
  const next = asset in exceptions ? row[row.indexOf(now ?? null) + 1] : row[0];
  return next === undefined ? others : { ...others, [asset]: next };
}

/** `21 are leg, 2 panel; 1 left out`. */
export function groupText({ hulls }: ReviewQuestionView, label: string, exceptions: Exceptions): string {
  const counts = new Map<string | null, number>();
  for (const { asset } of hulls) {
    const given = asset in exceptions ? (exceptions[asset] ?? null) : label;
    counts.set(given, (counts.get(given) ?? 0) + 1);
  }
  const left = counts.get(null);
  const words = [...counts].flatMap(([name, count]) => (name === null ? [] : `${count} ${name}`));
  return [words.join(", "), left ? `${left} left out` : ""].filter(Boolean).join("; ");
}
