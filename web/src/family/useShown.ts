// The assets that the family shows now.
import { useDesk } from "../store/desk";
import { shownAssets } from "../store/family";
import { useProject } from "../store/project";

export function useShown(): readonly string[] {
  useProject((state) => state.cards);
  useProject((state) => state.order);
  useProject((state) => state.project.vocabulary);
  useDesk((desk) => desk.filters);
  return shownAssets();
}
