// The picture of an asset as a rule meets it, while a card shows it.
import { useEffect, useState } from "react";
import { decoded } from "../../pictures/store";
import { rulePicture } from "../../store/pictures";
import { useProject } from "../../store/project";

export interface Seen {
  readonly names: readonly string[];
  readonly png: Blob;
  /** Names of the hulls that are in sight in it. */
  readonly inSight: ReadonlySet<string>;
}

/** So many pixels of a picture are needed to see a hull in it. */
const ENOUGH = 300;

/** The picture; null while it comes, "failed" where there is none. */
export function useRulePicture(asset: string, rule: number): Seen | "failed" | null {
  const version = useProject((state) => `${state.lesson?.number ?? 0} ${state.shapeRevisions[asset] ?? 0}`);
  const key = `${asset} ${rule} ${version}`;
  const [got, setGot] = useState<{ key: string; picture: Seen | "failed" } | null>(null);
  useEffect(() => {
    let wanted = true;
    const take = (picture: Seen | "failed") => wanted && setGot({ key, picture });
    seen(asset, rule, version).then(take, () => take("failed"));
    return () => {
      wanted = false;
    };
  }, [asset, rule, version, key]);
  return got?.key === key ? got.picture : null;
}

async function seen(asset: string, rule: number, version: string): Promise<Seen> {
  const { names, png } = await rulePicture(asset, rule, version);
  const { ids } = await decoded(png);
  const pixels = new Uint32Array(names.length + 1);
  for (const id of ids) pixels[id] = (pixels[id] ?? 0) + 1;
  return { names, png, inSight: new Set(names.filter((_, k) => (pixels[k + 1] ?? 0) >= ENOUGH)) };
}
