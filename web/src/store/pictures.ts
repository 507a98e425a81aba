// Pictures of assets as a rule meets them, fetched once for each program.
import { api } from "../server/api";

export interface RulePicture {
  readonly names: readonly string[];
  readonly png: Blob;
}

const MOST = 24;
const kept = new Map<string, Promise<RulePicture>>();

/** The asset as a rule (from 1) meets it; version: of what is shown, so that another one is fetched anew. */
export function rulePicture(asset: string, rule: number, version: string): Promise<RulePicture> {
  const key = [asset, rule, version].join("\n");
  const known = kept.get(key);
  if (known) return known;
  const fresh = api.picture(asset, rule);
  kept.set(key, fresh);
  fresh.catch(() => kept.delete(key));
  if (kept.size > MOST) kept.delete(kept.keys().next().value ?? "");
  return fresh;
}
