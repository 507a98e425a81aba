// Commands that go somewhere: to assets, stages, undo and redo, help, and what surrounds them.
import { type DeskState, openAsset, openStage, STAGES, useDesk } from "../store/desk";
import { redo, undo } from "../store/edits";
import { has, neighbour, shownAssets } from "../store/family";
import { setLayout, useLayout } from "../store/layout";
import { useProject } from "../store/project";
import { beginTour } from "../store/tour";
import type { Command } from "./command";

function goBeside(by: 1 | -1): void {
  const next = neighbour(shownAssets(), useProject.getState().order, useDesk.getState().asset, by);
  if (next !== null) openAsset(next);
}

/** The next asset that wants to be looked at: flagged, failed, or with labels that are not sure. */
export function nextDoubtful(): string | null {
  const { cards, order } = useProject.getState();
  const doubtful = (asset: string) => {
    const card = cards[asset];
    return card !== undefined && (has(card, "flagged") || has(card, "failed") || has(card, "unsure"));
  };
  return neighbour(order, order, useDesk.getState().asset, 1, doubtful);
}

function toggleOverlay(overlay: DeskState["overlay"]): void {
  useDesk.setState((desk) => ({ overlay: desk.overlay === overlay ? "none" : overlay }));
}

const NAMES = { label: "Label", demonstrate: "Demonstrate", learn: "Learn", review: "Review" } as const;

const stages: readonly Command[] = STAGES.map((stage, k) => ({
  id: `stage-${stage}`,
  title: `Stage ${k + 1}: ${NAMES[stage]}`,
  group: "Go",
  keys: [`Alt+${k + 1}`],
  run: () => openStage(stage),
}));

const assets = () => useProject.getState().order.length > 1;

function goOn(): void {
  const { next } = useProject.getState().project;
  openStage(next.stage);
  if (next.asset !== null) openAsset(next.asset);
}

export const going: readonly Command[] = [
  { id: "next-asset", title: "Next asset", group: "Go", keys: ["Tab"], enabled: assets, run: () => goBeside(1) },
  {
    id: "previous-asset",
    title: "Previous asset",
    group: "Go",
    keys: ["Shift+Tab"],
    enabled: assets,
    run: () => goBeside(-1),
  },
  {
    id: "next-doubtful",
    title: "Next asset that is flagged, failed or unsure",
    group: "Go",
    keys: ["N"],
    enabled: () => ["demonstrate", "learn"].includes(useDesk.getState().stage) && nextDoubtful() !== null,
    run: () => openAsset(nextDoubtful()),
  },
  ...stages,
  { id: "go-on", title: "Go to what is next", group: "Go", keys: ["Alt+Enter"], run: goOn },
  {
    id: "undo",
    title: "Undo",
    group: "Edit",
    keys: ["Ctrl+Z"],
    enabled: () => useProject.getState().history.undo !== null,
    run: undo,
  },
  {
    id: "redo",
    title: "Redo",
    group: "Edit",
    keys: ["Ctrl+Shift+Z", "Ctrl+Y"],
    enabled: () => useProject.getState().history.redo !== null,
    run: redo,
  },
  {
    id: "gallery",
    title: "Family fills the centre",
    group: "View",
    keys: ["Q"],
    run: () => setLayout({ gallery: !useLayout.getState().gallery }),
  },
  {
    id: "family",
    title: "Show or hide the family's column",
    group: "View",
    keys: ["F9"],
    run: () => setLayout({ family: !useLayout.getState().family }),
  },
  {
    id: "theme",
    title: "Light, dark, or as the system",
    group: "View",
    keys: [],
    run: () => useDesk.setState(({ theme }) => ({ theme: turned(theme) })),
  },
  {
    id: "palette",
    title: "Find a command or an asset",
    group: "Go",
    keys: ["Ctrl+K", "/"],
    run: () => toggleOverlay("palette"),
  },
  { id: "help", title: "Keys and help", group: "Go", keys: ["?", "F1"], run: () => toggleOverlay("help") },
  { id: "tour", title: "Guided tour", group: "Go", keys: [], run: beginTour },
];

const THEMES = ["system", "light", "dark"] as const;
const turned = (theme: DeskState["theme"]) => THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length] ?? "system";
