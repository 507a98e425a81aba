// The picture of an asset as a rule meets it, with some of its hulls in a strong colour; fetched once for each program.
import { useCallback, useMemo } from "react";
import { IdPicture } from "../../pictures/IdPicture";
import { hullAt } from "../../pictures/idMap";
import { decodePicture } from "../../pictures/pictureCache";
import { useFetched } from "../../pictures/useFetched";
import { api } from "../../server/api";
import { keepLatest } from "../../store/once";
import { useProject } from "../../store/project";
import css from "./learn.module.css";

export function HullsPicture({ picture, hulls, label }: {
  picture: RulePictureView | "failed" | null;
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
  const fill = useCallback((position: number) => (marked.has(position) ? "outlined" : "solid"), [marked]);
  if (picture === "failed") return <div className={css.noPicture}>No picture</div>;
  if (!picture) return <div className={css.noPicture} aria-hidden />;
  return <IdPicture png={picture.png} label={label} colors={colors} fill={fill} className={css.picture ?? ""} />;
}

type RulePicture = Awaited<ReturnType<typeof api.picture>>;
export interface RulePictureView extends RulePicture {
  /** Names of the hulls that are in sight in it. */
  readonly inSight: ReadonlySet<string>;
}

/** So many pixels of a picture are needed to see a hull in it. */
const ENOUGH = 100;

const NO_HULLS: readonly string[] = [];

/** The picture, in which some hulls can be seen if at all; null while it comes, "failed" where there is none. */
export function useRulePicture(asset: string, rule: number, show: readonly string[] = NO_HULLS): RulePictureView | "failed" | null {
  const version = useProject((state) => `${state.outcome?.number ?? 0} ${state.shapeRevisions[asset] ?? 0}`);
  const shown = show.slice(0, MOST_SHOWN).join("\n");
  const fetch = useCallback(() => fetchView(asset, rule, version, shown ? shown.split("\n") : NO_HULLS), [asset, rule, version, shown]);
  return useFetched(fetch);
}

/** An address holds no more names. */
const MOST_SHOWN = 60;

async function fetchView(asset: string, rule: number, version: string, show: readonly string[]): Promise<RulePictureView> {
  const { names, png } = await rulePicture(asset, rule, version, show);
  const { data } = await decodePicture(png);
  const pixels = new Uint32Array(names.length);
  for (let k = 0; 4 * k < data.length; k++) {
    const hull = hullAt(data, k);
    pixels[hull] = (pixels[hull] ?? 0) + 1;
  }
  return { names, png, inSight: new Set(names.filter((_, k) => (pixels[k] ?? 0) >= ENOUGH)) };
}

const MOST = 24;
const kept = new Map<string, Promise<RulePicture>>();

/** The asset as a rule (from 1) meets it; version: of what is shown, so that another one is fetched anew. */
function rulePicture(asset: string, rule: number, version: string, show: readonly string[]): Promise<RulePicture> {
  const key = [asset, rule, version, ...show].join("\n");
  const known = kept.get(key);
  if (known) return known;
  const fresh = api.picture(asset, rule, show);
  keepLatest(kept, key, fresh, MOST);
  fresh.catch(() => kept.delete(key));
  return fresh;
}
