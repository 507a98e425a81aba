// Where one was in this tab: asset and stage, so that loading the page again loses no place.
import { type StageName, STAGES, useDesk } from "../store/desk";

const KEY = "meshforge.place";

export function place(): { asset: string | null; stage: StageName | null } {
  try {
    const { asset, stage } = JSON.parse(sessionStorage.getItem(KEY) ?? "{}") as Record<string, unknown>;
    return {
      asset: typeof asset === "string" ? asset : null,
      stage: STAGES.find((known) => known === stage) ?? null,
    };
  } catch {
    return { asset: null, stage: null };
  }
}

export function rememberPlace(): void {
  useDesk.subscribe(({ asset, stage }, before) => {
    if (asset === before.asset && stage === before.stage) return;
    sessionStorage.setItem(KEY, JSON.stringify({ asset, stage }));
  });
}
