// The guided tour of the demo: its marks, and how far one is; knows no DOM.
import { create } from "zustand";
import { sureText } from "./assessment";
import { type WorkspaceState, useWorkspace } from "./workspace";
import { type ProjectState, useProject } from "./project";
import { useScenes } from "./scenes";

interface TourStop {
  /** The part of the window that it points at: its `data-tour`. */
  at: "family" | "view" | "steps" | "panel" | "stages" | "hulls";
  title: string;
  text: string | ((project: ProjectState) => string);
  /** Whether the person has done it; without, Next goes on. */
  done?: (project: ProjectState, workspace: WorkspaceState) => boolean;
}

/** Which labels the selected hulls have. */
function selectedLabels(workspace: WorkspaceState): ReadonlySet<string | null> {
  const { scene } = useScenes.getState();
  return new Set(scene?.hulls.filter((hull) => workspace.selection.has(hull.name)).map((hull) => hull.label));
}

const countDemonstrated = (project: ProjectState) => Object.values(project.cards).filter((card) => card.demonstrated).length;
const onlyHas = (workspace: WorkspaceState, label: string) => {
  const labels = selectedLabels(workspace);
  return labels.size === 1 && labels.has(label);
};

/** How the tables came out, with nothing said of what is not known. */
function tablesText({ assessment }: ProjectState): string {
  if (!assessment?.assets.length) return "MeshForge still works out how sure it is of each table.";
  if (!assessment.held) return `${sureText(assessment)}.`;
  const rest = assessment.held === 1 ? "the other one may be wrong" : `the other ${assessment.held} may be wrong`;
  return `${sureText(assessment)}; ${rest}. Look at these first, and answer what 3 Learn asks about them.`;
}

export const TOUR_STOPS: readonly TourStop[] = [
  {
    at: "family",
    title: "A family of tables",
    text:
      "Each table is a set of convex hulls, and every hull has a label: that is its colour. " +
      "You demonstrate an edit on one table. MeshForge learns it and applies it to all.",
  },
  {
    at: "stages",
    title: "Four stages",
    text: "The tables are already labelled. Open 2 Demonstrate.",
    done: (_, workspace) => workspace.stage === "demonstrate",
  },
  {
    at: "view",
    title: "Select the splinters",
    text:
      "Objects on the tables and splinters of the decomposition are labelled misc. " +
      "Click one, then press Shift+L to select all hulls with its label.",
    done: (project, workspace) => onlyHas(workspace, "misc") || project.project.rules.length > 0,
  },
  {
    at: "panel",
    title: "Delete them",
    text: "Press X. The hulls to delete are dashed. Press Enter to make this the first step.",
    done: (project) => project.project.rules.length > 0,
  },
  {
    at: "view",
    title: "Make the table top one box",
    text: "Click a hull of the top, press Shift+L for all of it, then R, choose box, and press Enter.",
    done: (project) => project.project.rules.length > 1,
  },
  {
    at: "panel",
    title: "The second table is easier",
    text: "Press Tab to open another table. MeshForge guesses both steps: accept each with Enter, or correct it.",
    done: (project) => countDemonstrated(project) > 1,
  },
  {
    at: "stages",
    title: "MeshForge has learned",
    text: "Open 3 Learn to see the program.",
    done: (_, workspace) => workspace.stage === "learn",
  },
  {
    at: "panel",
    title: "The program, in words",
    text:
      "Point at a rule to highlight its hulls on all tables. " +
      "MeshForge asks what is still ambiguous: choose the right picture. Then open 4 Review.",
    done: (_, workspace) => workspace.stage === "review",
  },
  {
    at: "panel",
    title: "Apply to all tables",
    text: "Press Apply to all. The program edits every table and writes each to its own file.",
    done: (project) => Object.values(project.cards).some((card) => card.output === "edited"),
  },
  {
    at: "panel",
    title: "Look before you export",
    text: (project) =>
      `${tablesText(project)} Compare before and after. Accept what is right; flag or correct what is wrong; then export. ` +
      "Press ? for all keys. You can undo everything.",
  },
];

/** step: of the mark that is shown, null while the tour is not; back: one came back to it, and stays till Next. */
export const useTour = create<{ step: number | null; back: boolean }>()(() => ({ step: null, back: false }));

export function startTour(): void {
  useTour.setState({ step: 0, back: false });
}

export function endTour(): void {
  useTour.setState({ step: null, back: false });
}

/** To the next mark whose deed is not done yet, or back to the one before. */
export function moveTour(by: 1 | -1): void {
  const step = useTour.getState().step ?? 0;
  if (by === -1) return useTour.setState({ step: Math.max(step - 1, 0), back: true });
  const next = TOUR_STOPS.findIndex((mark, k) => k > step && !isDone(mark));
  useTour.setState({ step: next < 0 ? null : next, back: false });
}

const isDone = (mark: TourStop) => mark.done?.(useProject.getState(), useWorkspace.getState()) ?? false;

/** Goes on whenever the person has done what a mark asks for; until the returned function is called. */
export function followTour(): () => void {
  const look = () => {
    const { step, back } = useTour.getState();
    const mark = step === null || back ? undefined : TOUR_STOPS[step];
    if (mark && isDone(mark)) moveTour(1);
  };
  const stops = [useProject.subscribe(look), useWorkspace.subscribe(look)];
  return () => stops.forEach((stop) => stop());
}
