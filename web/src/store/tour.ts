// The guided tour of the demo: its marks, and how far one is; knows no DOM.
import { create } from "zustand";
import { type WorkspaceState, useWorkspace } from "./workspace";
import { type ProjectState, useProject } from "./project";
import { useScenes } from "./scenes";

interface TourStop {
  /** The part of the window that it points at: its `data-tour`. */
  at: "family" | "view" | "steps" | "panel" | "stages" | "hulls";
  title: string;
  text: string;
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

export const TOUR_STOPS: readonly TourStop[] = [
  {
    at: "family",
    title: "A family of tables",
    text:
      "Each table is a set of convex hulls, and every hull has a label: that is its colour. " +
      "You show on one table what is to be done; MeshForge learns it and does it to all.",
  },
  {
    at: "stages",
    title: "Four stages",
    text: "The labels are there already. Go on to 2 Demonstrate.",
    done: (_, workspace) => workspace.stage === "demonstrate",
  },
  {
    at: "view",
    title: "Pick the splinters",
    text:
      "What lies on the tables, and splinters of the cutting, are labelled misc. " +
      "Click one, then press Shift+L: all hulls with its label are selected.",
    done: (project, workspace) => onlyHas(workspace, "misc") || project.project.rules.length > 0,
  },
  {
    at: "panel",
    title: "Delete them",
    text: "Press X: what will go is dashed. Enter makes it the first step.",
    done: (project) => project.project.rules.length > 0,
  },
  {
    at: "view",
    title: "Make the table top one box",
    text: "Click a hull of the top, Shift+L for all of it, then R, choose box, and Enter.",
    done: (project) => project.project.rules.length > 1,
  },
  {
    at: "panel",
    title: "The second table is easier",
    text: "Press Tab to go to another table. Both steps are guessed there: accept each with Enter, or correct it.",
    done: (project) => countDemonstrated(project) > 1,
  },
  {
    at: "stages",
    title: "It has learned meanwhile",
    text: "Open 3 Learn to see the program.",
    done: (_, workspace) => workspace.stage === "learn",
  },
  {
    at: "panel",
    title: "The program, in words",
    text:
      "Point at a rule, and its hulls light up on all tables. " +
      "What is still open is asked: choose the picture that you mean. Then go on to 4 Review.",
    done: (_, workspace) => workspace.stage === "review",
  },
  {
    at: "panel",
    title: "Do it to all",
    text: "Press Apply to all: the program edits every table, each into a file of its own.",
    done: (project) => Object.values(project.cards).some((card) => card.output === "edited"),
  },
  {
    at: "panel",
    title: "That is all",
    text:
      "Compare before and after, accept what is right, flag what is not, or correct it by hand; then export. " +
      "Press ? for all keys. Undo takes anything back.",
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
