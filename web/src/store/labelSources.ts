// Where labels could come from besides the hulls that have one: files beside the assets, and names.
import { useEffect } from "react";
import { create } from "zustand";
import { api } from "../server/api";
import type { LabelSources } from "../wire";
import { countReadable, useProject } from "./project";

export const useLabelSources = create<LabelSources>()(() => ({ files: 0, names: 0 }));

/** Asks how much there is, anew when labels or assets change, and as more assets are read. */
export function useFreshSources(): void {
  const vocabulary = useProject((state) => state.project.vocabulary);
  const assets = useProject((state) => state.order.length);
  const read = useProject((state) => countReadable(state.cards));
  const labelled = useProject((state) => state.jobs.find((job) => job.kind === "label")?.state);
  useEffect(() => {
    let is = true;
    const timer = setTimeout(() => {
      void api.labelSources().then((found) => is && useLabelSources.setState(found, true));
    }, 250);
    return () => {
      is = false;
      clearTimeout(timer);
    };
  }, [vocabulary, assets, read, labelled]);
}
