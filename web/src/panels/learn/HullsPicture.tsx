// A picture of an asset with some of its hulls in a strong colour and the others pale.
import { useCallback, useMemo } from "react";
import { IdPicture } from "../../pictures/IdPicture";
import css from "./learn.module.css";
import type { Seen } from "./useRulePicture";

export function HullsPicture({ picture, hulls, label }: {
  picture: Seen | "failed" | null;
  hulls: readonly string[];
  label: string;
}) {
  const names = picture === "failed" ? undefined : picture?.names;
  const marked = useMemo(() => {
    const wanted = new Set(hulls);
    return new Set((names ?? []).flatMap((name, k) => (wanted.has(name) ? [k] : [])));
  }, [names, hulls]);
  const colors = useCallback(
    (position: number) => {
      if (position < 0) return "var(--hull-opaque)";
      return marked.has(position) ? "var(--highlight)" : "var(--hull-pale)";
    },
    [marked],
  );
  if (picture === "failed") return <div className={css.noPicture}>No picture</div>;
  if (!picture) return <div className={css.noPicture} aria-hidden />;
  return <IdPicture png={picture.png} label={label} colors={colors} className={css.picture ?? ""} />;
}
