// The hulls that a question is about, each in its place on its asset; exceptions get another label, or are left out.
import { type MouseEvent, useMemo } from "react";
import { Thumbnail } from "../../pictures/Thumbnail";
import { exceptionOf, type Exceptions, type HullInQuestion, keyOf } from "../../store/assessment";
import { findOwnParts } from "../../store/commonParts";
import { useOwnNames, useProject } from "../../store/project";
import { oncePer } from "../../store/once";
import { countText } from "../../store/words";
import { visit } from "../../store/workspace";
import { Name } from "../../ui/Name";
import { Swatch } from "../../ui/Section";
import type { ReviewQuestionView } from "../../wire";
import { HullsPicture, useRulePicture } from "../learn/RulePicture";
import css from "./questions.module.css";

/** Hulls whose pictures are drawn; the others are counted. */
const MOST = 200;

/** Of so few, each is drawn from a side where it is seen. */
const FEW = 24;

interface GroupHullsProps {
  question: ReviewQuestionView;
  exceptions: Exceptions;
  onChange: (exceptions: Exceptions) => void;
}

export function GroupHulls({ question, exceptions, onChange }: GroupHullsProps) {
  const { kind, hulls, choices } = question;
  const ownName = useOwnNames();
  const drawn = hulls.slice(0, MOST);
  const labels = choices.flatMap((choice) => choice.label ?? []);
  const canVary = kind === "group" && hulls.length > 1 && labels.length > 0;
  return (
    <ul className={css.group} data-few={hulls.length < 3} aria-label={countText(hulls.length, "hull")} tabIndex={-1}>
      {[...new Set(drawn.map(({ asset }) => asset))].map((asset) => {
        const own = drawn.filter((one) => one.asset === asset);
        const shortOf = findOwnParts(own.map(({ hull }) => hull));
        const vary = (one: HullInQuestion, { shiftKey }: MouseEvent) =>
          onChange(nextException(exceptions, [one, ...(shiftKey ? own : [])].map(keyOf), labels));
        return (
          <li key={asset} className={css.asset} data-several={own.length > 1}>
            <span className={css.where} title={asset}>
              <Name text={asset} own={ownName(asset)} />
              {own.length > 1 && <b> ×{own.length}</b>}
            </span>
            {own.map((one) => (
              <div key={one.hull} className={css.member} data-exception={keyOf(one) in exceptions}>
                <button
                  type="button"
                  className={css.look}
                  title={`${asset}: ${one.hull}`}
                  aria-label={`Open ${asset} with ${one.hull} selected`}
                  onClick={() => visit(asset, { kind: "source" }, [one.hull])}
                >
                  {hulls.length > FEW ? <InPlace asset={asset} place={one.place} /> : <InSight asset={asset} names={namesOf(one)} />}
                  {own.length > 1 && <span className={css.where}>{shortOf(one.hull)}</span>}
                </button>
                {canVary && (
                  <button type="button" className={css.label} onClick={(event) => vary(one, event)} title="Another label, or left out; with Shift for all of this asset">
                    <span className="visually-hidden">
                      {one.hull} of {asset}:{" "}
                    </span>
                    <Label name={exceptionOf(one, exceptions, labels[0])} />
                  </button>
                )}
              </div>
            ))}
          </li>
        );
      })}
      {hulls.length > MOST && <li className={css.dim}>and {countText(hulls.length - MOST, "more hull")}</li>}
    </ul>
  );
}

const namesOf = oncePer((one: HullInQuestion) => [one.hull]);

/** An asset from a side where the hulls in question are seen, or through what hides them. */
export function InSight({ asset, names }: { asset: string; names: readonly string[] }) {
  return <HullsPicture picture={useRulePicture(asset, 1, names)} hulls={names} label="" />;
}

/** An asset as its card shows it, with a hull pointed out. */
function InPlace({ asset, place }: { asset: string; place: number }) {
  return <Thumbnail asset={asset} of="source" highlight={useMemo(() => [place], [place])} label="" />;
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

/** From one label of a question to the next, then left out, then as the others again; of the first hull, and so of all. */
export function nextException(exceptions: Exceptions, keys: readonly string[], labels: readonly string[]): Exceptions {
  const [first = ""] = keys;
  const row = [...labels.slice(1), null];
  const next = first in exceptions ? row[row.indexOf(exceptions[first] ?? null) + 1] : row[0];
  const others = Object.entries(exceptions).filter(([key]) => !keys.includes(key));
  return Object.fromEntries([...others, ...(next === undefined ? [] : keys.map((key) => [key, next] as const))]);
}

/** `21 are leg, 2 panel; 1 left out`. */
export function groupText({ hulls }: ReviewQuestionView, label: string, exceptions: Exceptions): string {
  const counts = new Map<string | null, number>();
  for (const one of hulls) {
    const given = exceptionOf(one, exceptions, label);
    counts.set(given, (counts.get(given) ?? 0) + 1);
  }
  const left = counts.get(null);
  const words = [...counts].flatMap(([name, count]) => (name === null ? [] : `${count} ${name}`));
  return [words.join(", "), left ? `${left} left out` : ""].filter(Boolean).join("; ");
}
