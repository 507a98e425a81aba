// Pictures that were fetched, decoded; the latest few hundred are kept.
import { firstPicture } from "../viewport/firstPicture";
import { decoded } from "./decoding";
import type { IdMap } from "./idmap";
import { Line } from "./line";

const MOST = 400;
// a browser has six connections to a server: edits must not wait until pictures are drawn
const line = new Line<IdMap>(3);
const kept = new Map<string, IdMap>();

/** A picture that is there already. */
export function known(url: string): IdMap | null {
  const map = kept.get(url);
  if (!map) return null;
  kept.delete(url);
  kept.set(url, map);
  return map;
}

/** Fetches a picture, once for all that want it; the last that was asked for comes first. */
export function wanted(url: string): { picture: Promise<IdMap>; drop: () => void } {
  const { result, drop } = line.ask(url, () => fetchOne(url));
  return { picture: result, drop };
}

async function fetchOne(url: string): Promise<IdMap> {
  await firstPicture();
  const answer = await fetch(url);
  if (!answer.ok) throw new Error(`no picture: ${answer.status}`);
  const map = await decoded(await answer.blob());
  kept.set(url, map);
  if (kept.size > MOST) kept.delete(kept.keys().next().value ?? "");
  return map;
}

export { decoded };
