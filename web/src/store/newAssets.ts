// Assets that came after the others were prepared, which a run prepares first, and what a person wants of that.
import { create } from "zustand";
import type { Job, JobLine, NewAssetsView } from "../wire";
import { percentText } from "./assessment";
import { countText, shortName, toSentence } from "./words";

/** Whether a run rebuilds bodies of new assets of which a hull spans parts, where the project's own were rebuilt. */
export const useRebuildChoice = create<{ rebuild: boolean }>()(() => ({ rebuild: true }));

/** What a run does before it applies the program; null where there is nothing to say. */
export function newAssetsText({ ids, unclear }: NewAssetsView): string | null {
  const which = ids.length === 1 ? `${shortName(ids[0] ?? "")} is` : `${countText(ids.length, "asset")} are`;
  const texts = [ids.length > 0 && `${which} new, and prepared first as the others were.`, unclear && toSentence(unclear)];
  return texts.filter(Boolean).join(" ") || null;
}

/** The choice whether bodies are rebuilt, in words; null where no hull would be looked at. */
export function rebuildChoiceText({ rebuilt, min_confidence }: NewAssetsView): string | null {
  if (!rebuilt || min_confidence === null) return null;
  return `Rebuild their bodies where a hull spans parts, from ${percentText(min_confidence)} on`;
}

/** What became of new assets in a run. */
export const linesOfNew = (job: Job): readonly JobLine[] => job.lines.filter((line) => line.before.length > 0);
