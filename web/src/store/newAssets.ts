// Assets that came after the others were prepared, which a run prepares first, and what a person wants of that.
import { create } from "zustand";
import type { Job, JobLine, NewAssetsView } from "../wire";
import { percentText } from "./assessment";
import { countText, shortName, toSentence } from "./words";

/** Whether a run splits hulls of new assets that span parts, where the project's own were split. */
export const useSplitChoice = create<{ split: boolean }>()(() => ({ split: true }));

/** What a run does before it applies the program; null where there is nothing to say. */
export function newAssetsText({ ids, unclear }: NewAssetsView): string | null {
  const which = ids.length === 1 ? `${shortName(ids[0] ?? "")} is` : `${countText(ids.length, "asset")} are`;
  const texts = [ids.length > 0 && `${which} new, and prepared first as the others were.`, unclear && toSentence(unclear)];
  return texts.filter(Boolean).join(" ") || null;
}

/** The choice whether hulls are split, in words; null where no hull would be looked at. */
export function splitChoiceText({ split, sure, rebuild }: NewAssetsView): string | null {
  if (!split || sure === null) return null;
  const doing = rebuild ? "Make bodies anew of which hulls span parts" : "Split their hulls that span parts";
  return `${doing}, from ${percentText(sure)} on`;
}

/** What became of new assets in a run. */
export const linesOfNew = (job: Job): readonly JobLine[] => job.lines.filter((line) => line.before.length > 0);
