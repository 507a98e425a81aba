// The question whether a hull that likely spans parts is to be split: its parts in colour, in the card and in the view.
import { Check, X } from "lucide-react";
import { useCallback, useEffect, useState } from "react";
import { putOff, reply, showAsked } from "../../commands/question";
import { IdPicture } from "../../pictures/IdPicture";
import { api } from "../../server/api";
import { groupParts, type PartGroup, showHullParts, useHullParts } from "../../store/hullParts";
import { useProject } from "../../store/project";
import { Swatch } from "../../ui/Section";
import type { HullView, ReviewQuestionView } from "../../wire";
import { useCardKeys } from "./cardKeys";
import css from "./questions.module.css";
import { LaterReply, Reply, ShowReply } from "./Replies";

export function SpanCard({ question }: { question: ReviewQuestionView }) {
  const { id, hulls } = question;
  const { asset, hull } = hulls[0] ?? { asset: "", hull: "" };
  useEffect(() => showHullParts(asset, hull), [id, asset, hull]);
  const parts = useHullParts((state) => state.shown?.packet.header.parts) ?? NO_PARTS;
  const split = () => void reply(question, 0);
  const keep = () => void reply(question, 1);
  const later = () => void putOff(question);
  const show = () => showAsked(question);
  const doing = useCardKeys({ choices: [split, keep], accept: split, reject: keep, later, show });
  return (
    <section className={css.card} aria-labelledby="asked">
      <h3 id="asked">{question.text}</h3>
      <button type="button" className={css.look} onClick={show} aria-label={`Open ${question.asset} with the hull in its parts`}>
        <PartsPicture id={id} asset={asset} hull={hull} parts={parts} />
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
    </section>
  );
}

const NO_PARTS: readonly HullView[] = [];

/** Parts of one label: how many, and how sure it is of each. */
function Part({ label, count, share }: PartGroup) {
  const color = useLabelColors()(label);
  return (
    <li>
      <Swatch color={color} /> {label}
      {count > 1 && <b>×{count}</b>}
      <span className={css.facts}>{share}</span>
    </li>
  );
}

function useLabelColors(): (label: string | null) => string {
  const vocabulary = useProject((state) => state.project.vocabulary);
  return useCallback((label) => vocabulary.find(({ name }) => name === label)?.color ?? "var(--hull-unlabelled)", [vocabulary]);
}

interface Place {
  /** Of the question, so that parts that were found anew are fetched anew. */
  id: string;
  asset: string;
  hull: string;
}

interface Picture {
  readonly names: readonly string[];
  readonly png: Blob;
}

/** The asset with the parts in the place of the hull, in the colours of their labels, all else pale. */
function PartsPicture({ parts, ...place }: Place & { parts: readonly HullView[] }) {
  const picture = usePartsPicture(place);
  const colorOf = useLabelColors();
  const names = picture === "failed" ? undefined : picture?.names;
  const colors = useCallback(
    (position: number) => {
      const part = parts.find(({ name }) => name === names?.[position]);
      if (part) return colorOf(part.label);
      return position < 0 ? "var(--hull-opaque)" : "var(--hull-pale)";
    },
    [parts, names, colorOf],
  );
  if (picture === "failed") return <div className={css.missing}>No picture</div>;
  if (!picture) return <div className={css.missing} aria-hidden />;
  return <IdPicture png={picture.png} label="" colors={colors} className={css.partsPicture ?? ""} />;
}

function usePartsPicture({ id, asset, hull }: Place): Picture | "failed" | null {
  const [got, setGot] = useState<{ id: string; picture: Picture | "failed" } | null>(null);
  useEffect(() => {
    let wanted = true;
    const take = (picture: Picture | "failed") => wanted && setGot({ id, picture });
    api.partsPicture(asset, hull).then(take, () => take("failed"));
    return () => {
      wanted = false;
    };
  }, [id, asset, hull]);
  return got?.id === id ? got.picture : null;
}
