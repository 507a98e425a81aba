// The small picture of an asset, in the colours of its labels, or pointing out some of its hulls.
import { memo, useCallback, useMemo } from "react";
import { api } from "../server/api";
import { useProject } from "../store/project";
import { GIVEN, isUnsure, UNLABELLED } from "../store/family";
import { hueOf } from "./cssColor";
import type { Fill } from "./hullColors";
import { IdPicture } from "./IdPicture";
import css from "./pictures.module.css";

interface ThumbnailProps {
  asset: string;
  of: "source" | "output";
  /** Positions of hulls to point out; the others are pale. */
  highlight?: readonly number[] | undefined;
  /** The directive by which it is turned, in place of the project's. */
  turned?: string | null;
  /** What is up, in place of what the project says. */
  up?: "y" | "z";
  /** Width in CSS pixels; it fills its place without. */
  size?: number;
  /** What a screen reader says; empty where words beside it say the same. */
  label?: string;
}

export const Thumbnail = memo(function Thumbnail({ asset, of, highlight, turned, up, size, label }: ThumbnailProps) {
  const version = useProject(({ cards }) => cards[asset]?.[of === "source" ? "picture" : "edited_picture"] ?? null);
  const labels = useProject(({ cards }) => cards[asset]?.[of === "source" ? "labels" : "after_labels"]);
  const confidence = useProject(({ cards }) => cards[asset]?.confidence);
  const palette = useProject(({ project }) => project.vocabulary.map((entry) => entry.color).join(" "));
  const run = useProject(({ outcome }) => outcome?.number ?? 0); // labels may turn it otherwise in the next one
  const marked = useMemo(() => (highlight ? new Set(highlight) : null), [highlight]);
  const colors = useCallback(
    (k: number) => {
      if (k < 0) return "var(--hull-opaque)";
      if (marked) return marked.has(k) ? "var(--highlight)" : "var(--hull-pale)";
      if (of === "output" && !labels?.length) return hueOf(k);
      return palette.split(" ")[labels?.[k] ?? -1] || "var(--hull-unlabelled)";
    },
    [marked, of, labels, palette],
  );
  const fill = useCallback(
    (k: number): Fill | "outlined" => {
      if (marked?.has(k)) return "outlined";
      const sure = marked || of === "output" ? UNLABELLED : (confidence?.[k] ?? UNLABELLED);
      return isUnsure(sure) ? "hatched" : sure === UNLABELLED || sure === GIVEN ? "solid" : "dotted";
    },
    [marked, of, confidence],
  );
  if (version === null) return <Blank size={size} />;
  const text = label ?? `${of === "source" ? "Picture" : "Picture of the edited asset"}: ${asset}`;
  const url = up ? api.withUp(asset, up, version) : turned ? api.turned(asset, turned, run) : api.thumbnail(asset, of, version);
  return <IdPicture url={url} label={text} colors={colors} fill={fill} width={size} />;
});

/** Keeps the place of a picture that is not there. */
function Blank({ size }: { size?: number | undefined }) {
  const style = size === undefined ? undefined : { width: size };
  return <div className={css.picture} style={style} data-state="none" aria-hidden />;
}
