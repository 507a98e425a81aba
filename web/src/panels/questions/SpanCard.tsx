// The question whether a hull that likely spans parts is to be split: its parts in colour, in the card and in the view.
import { Check, X } from "lucide-react";
import { useCallback, useEffect } from "react";
import { putOff, reply, showAsked } from "../../commands/question";
import { IdPicture } from "../../pictures/IdPicture";
import { useFetched } from "../../pictures/useFetched";
import { api } from "../../server/api";
import { countSpans, groupParts, type PartGroup, showHullParts, useHullParts } from "../../store/hullParts";
import { useProject } from "../../store/project";
import { Swatch } from "../../ui/Section";
import type { HullView, ReviewQuestionView } from "../../wire";
import { useCardKeys } from "./cardKeys";
import css from "./questions.module.css";
import { LaterReply, Reply, ShowReply } from "./Replies";

export function SpanCard({ question }: { question: ReviewQuestionView }) {
  const { id, hulls } = question;
  const { asset, hull, place } = hulls[0] ?? { asset: "", hull: "", place: -1 };
  useEffect(() => showHullParts(asset, hull), [id, asset, hull]);
  const parts = useHullParts((state) => state.shown?.packet.header.parts) ?? NO_PARTS;
  const rest = useProject(({ cards }) => countSpans(cards) - Number(hull in (cards[asset]?.spans ?? {})));
  const split = () => void reply(question, { choice: "yes" });
  const keep = () => void reply(question, { choice: "no" });
  const later = () => void putOff(question);
  const show = () => showAsked(question);
  const doing = useCardKeys({ choices: [keep, split], accept: split, reject: keep, later, show });
  return (
    <section className={css.card} aria-labelledby="asked">
      <h3 id="asked">{question.text}</h3>
      <button type="button" className={css.look} onClick={show} aria-label={`Open ${question.asset} with the hull in its parts`}>
        <PartsPicture key={id} asset={asset} hull={hull} place={place} parts={parts} />
        <span className={css.sides} aria-hidden>
          <span>as it is</span>
          <span>split</span>
        </span>
      </button>
      <ul className={css.parts} aria-label="Parts">
        {groupParts(parts).map((group) => (
          <Part key={group.label} {...group} />
        ))}
      </ul>
      <div className={css.row}>
        <Reply keyName="Y" look="primary" icon={Check} tip="A step in the preparation of the asset; undo takes it back" onClick={doing(split)}>
          Split so
        </Reply>
        <Reply keyName="N" icon={X} tip="It is not asked about again as long as it stays as it is" onClick={doing(keep)}>
          No, it is one part
        </Reply>
        <ShowReply onClick={doing(show)} />
        <LaterReply onClick={doing(later)} />
      </div>
      {rest > 0 && <p className={css.dim}>{rest === 1 ? "1 more hull likely spans parts." : `${rest} more hulls likely span parts.`}</p>}
    </section>
  );
}

const NO_PARTS: readonly HullView[] = [];

/** Parts of one label: how many, and how sure it is of each, empty where nothing is known of that. */
function Part({ label, count, share }: PartGroup) {
  const color = useLabelColors()(label);
  return (
    <li>
      <Swatch color={color} /> {label}
      {count > 1 && <b>×{count}</b>}
      {share && <span className={css.facts}>{share} sure</span>}
    </li>
  );
}

function useLabelColors(): (label: string | null) => string {
  const vocabulary = useProject((state) => state.project.vocabulary);
  return useCallback((label) => vocabulary.find(({ name }) => name === label)?.color ?? "var(--hull-unlabelled)", [vocabulary]);
}

interface PartsPictureProps {
  asset: string;
  hull: string;
  /** Of the hull among those of the asset. */
  place: number;
  parts: readonly HullView[];
}

/** The asset twice, with the hull and with the parts in its place, in the colours of their labels, all else pale. */
function PartsPicture({ asset, hull, place, parts }: PartsPictureProps) {
  const picture = useFetched(useCallback(() => api.partsPicture(asset, hull), [asset, hull]));
  const names = picture === "failed" ? undefined : picture?.names;
  const colorOf = useLabelColors();
  const own = useProject(({ cards, project }) => project.vocabulary[cards[asset]?.labels[place] ?? -1]?.color ?? "var(--text-dim)");
  const colors = useCallback(
    (position: number) => {
      const name = names?.[position];
      if (name === hull) return own;
      const part = parts.find((one) => one.name === name);
      return part ? colorOf(part.label) : position < 0 ? "var(--hull-opaque)" : "var(--hull-pale)";
    },
    [parts, names, hull, own, colorOf],
  );
  if (picture === "failed") return <div className={css.missing}>No picture</div>;
  if (!picture) return <div className={css.missing} aria-hidden />;
  return <IdPicture png={picture.png} label="" colors={colors} className={css.partsPicture ?? ""} />;
}
