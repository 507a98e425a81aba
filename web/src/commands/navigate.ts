// Commands that go somewhere: to assets, stages, undo and redo, help, and what surrounds them.
import { redo, undo } from "../store/edits";
import { callFor } from "../store/calls";
import { matchesFilter, neighbour } from "../store/family";
import { listBare, openDecompose, whyNotDecompose } from "../store/decompose";
import { saveEdits } from "../store/jobs";
import { walk } from "../store/labelWalk";
import { jobOfNext } from "../store/nextStep";
import { useProject } from "../store/project";
import { openBeside } from "../store/sheet";
import { notify } from "../store/toasts";
import { startTour } from "../store/tour";
import { openAsset, openStage, setLayout, STAGES, useLayout, useWorkspace, type WorkspaceState, STAGE_OF } from "../store/workspace";
import { type Command, commandsOf, NAMES, needs, unless } from "./command";
import { tryLabel } from "./label";

/** The next asset that wants to be looked at: wrong, flagged, failed, or with labels that are not sure. */
function nextDoubtful(): string | null {
  const { cards, order } = useProject.getState();
  const doubtful = (asset: string) => {
    const card = cards[asset];
    return card !== undefined && (matchesFilter(card, "wrong") || matchesFilter(card, "flagged") || matchesFilter(card, "failed") || matchesFilter(card, "unsure"));
  };
  return neighbour(order, order, useWorkspace.getState().asset, 1, doubtful);
}

function toggleOverlay(overlay: WorkspaceState["overlay"]): void {
  useWorkspace.setState((workspace) => ({ overlay: workspace.overlay === overlay ? "none" : overlay }));
}

const stageCommands: readonly Command[] = STAGES.map((stage, k) => ({
  id: `stage-${stage}`,
  title: `Stage ${k + 1}: ${NAMES[stage]}`,
  group: "Go",
  keys: [`Alt+${k + 1}`],
  run: () => openStage(stage),
}));

const hasOthers = needs("There is just one asset.", () => useProject.getState().order.length > 1);

const askForHulls = (): void => listBare(useProject.getState().cards).slice(0, 1).forEach(openDecompose);

/** Goes where the next step is done, and does it where one command does; what writes files waits at its button for Enter. */
export function goToNext(): unknown {
  const { next } = useProject.getState().project;
  openStage(STAGE_OF[next.kind]);
  if (next.asset !== null) openAsset(next.asset);
  if (jobOfNext(useProject.getState())) return;
  switch (next.kind) {
    case "decompose":
      return askForHulls();
    case "label-all":
      return tryLabel();
    case "check-labels":
      return walk();
    case "answer":
    case "review":
      return callFor("card");
    case "apply":
    case "export":
      return callFor(next.kind);
  }
}

export const goCommands = commandsOf("Go", [
  { id: "next-asset", title: "Next asset", keys: ["Tab"], enabled: hasOthers, run: () => openBeside(1) },
  {
    id: "previous-asset",
    title: "Previous asset",
    keys: ["Shift+Tab"],
    enabled: hasOthers,
    run: () => openBeside(-1),
  },
  {
    id: "next-doubtful",
    title: "Next asset that is wrong, flagged, failed or unsure",
    keys: ["N"],
    enabled: needs("None, or the stage has a queue of its own.", () => ["demonstrate", "learn"].includes(useWorkspace.getState().stage) && nextDoubtful() !== null),
    run: () => openAsset(nextDoubtful()),
  },
  ...stageCommands,
  { id: "go-on", title: "Go to the next step", keys: ["Alt+Enter"], words: "what is next", run: goToNext, movesFocus: true },
  {
    id: "undo",
    title: "Undo",
    group: "Edit",
    keys: ["Ctrl+Z"],
    words: "back revert",
    enabled: needs("Nothing to undo.", () => useProject.getState().history.undo !== null),
    run: undo,
  },
  {
    id: "redo",
    title: "Redo",
    group: "Edit",
    keys: ["Ctrl+Shift+Z", "Ctrl+Y"],
    enabled: needs("Nothing to redo.", () => useProject.getState().history.redo !== null),
    run: redo,
  },
  {
    id: "history",
    title: "History: jump to an earlier or a later state",
    group: "Edit",
    keys: ["Alt+Z"],
    words: "undo list",
    enabled: needs("Nothing was done yet.", () => useProject.getState().history.undoable + useProject.getState().history.redoable > 0),
    run: () => toggleOverlay("history"),
    movesFocus: true,
  },
  {
    id: "save",
    title: "Save: all is on disk already",
    group: "Edit",
    keys: ["Ctrl+S"],
    words: "store write",
    run: async () => {
      await saveEdits();
      notify("All that you did is on disk.");
    },
  },
  {
    id: "add",
    title: "Add assets: files or a folder",
    group: "Edit",
    words: "import load open drop",
    run: () => {
      setLayout({ family: true });
      callFor("add");
    },
    movesFocus: true,
  },
  {
    id: "decompose",
    title: "Make hulls for all assets that have none",
    group: "Edit",
    words: "decompose coacd vhacd convex",
    enabled: unless(whyNotDecompose),
    run: askForHulls,
  },
  {
    id: "gallery",
    title: "Show the family in the centre",
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
    title: "Theme: light, dark, or like the system",
    group: "View",
    words: "settings colours",
    run: () => useWorkspace.setState(({ theme }) => ({ theme: nextTheme(theme) })),
  },
  {
    id: "palette",
    title: "Find a command or an asset",
    keys: ["Ctrl+K", "/"],
    run: () => toggleOverlay("palette"),
  },
  { id: "help", title: "Keys and help", keys: ["?", "F1"], run: () => toggleOverlay("help") },
  { id: "tour", title: "Guided tour", run: startTour },
]);

const THEMES = ["system", "light", "dark"] as const;
const nextTheme = (theme: WorkspaceState["theme"]) => THEMES[(THEMES.indexOf(theme) + 1) % THEMES.length] ?? "system";
