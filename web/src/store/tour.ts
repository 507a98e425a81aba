// The guided tour of the demo: its marks, and how far one is; knows no DOM.
import { create } from "zustand";
import { countSigned, leftText, signedText } from "./assessment";
import { openText } from "./goals";
import { type WorkspaceState, useWorkspace } from "./workspace";
import { type ProjectState, useProject } from "./project";
import { isUpToDate } from "./reviews";
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

/** Whether a first program is learned, and it is known how sure its edits are. */
const isAssessed = ({ assessment }: ProjectState) => (assessment?.assets.length ?? 0) > 0;
const isSignedOff = ({ assessment, cards, confidence }: ProjectState) =>
  assessment !== null && assessment.assets.length > 0 && assessment.need_review === 0 && assessment.unseen === 0 && assessment.excluded === 0 && !openText({ cards, confidence });
/** Whether the person has answered what the program asked first. */
const hasAnswered = ({ project, assessment, cards }: ProjectState) =>
  project.answers.length > 0 || Object.values(cards).some((card) => card.review === "accepted") || assessment?.need_review === 0;

/** How the tables stand, with nothing said of what is not known. */
function tablesText({ assessment, cards, confidence }: ProjectState): string {
  if (!assessment?.assets.length) return "MeshForge is working out how sure it is of each table.";
  return [`${signedText(assessment, countSigned(assessment, cards))}.`, leftText(assessment, openText({ cards, confidence }))].filter(Boolean).join(" ");
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
    text:
      "The tables are already labelled. To label your own, press the digit of a label and point at a hull: a click paints it with " +
      "its outlined look-alikes. P then labels all other hulls, and N shows the least sure ones. Open 2 Demonstrate.",
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
    text: "Open 3 Learn to see the program, and what MeshForge asks about it.",
    done: (project, workspace) => workspace.stage === "learn" && isAssessed(project),
  },
  {
    at: "panel",
    title: "The first program is not right yet",
    text:
      "Some tables have a shelf, and the boards of a shelf are panels, too: the program would make one solid block of them. " +
      "MeshForge holds these tables, and asks. Choose the picture with the table top alone.",
    done: hasAnswered,
  },
  {
    at: "panel",
    title: "Answer until nothing is held",
    text: (project) =>
      `${tablesText(project)} One card at a time: press Y where it is right; where it is not, choose another reply, or N to ` +
      "say what is right. S shows what a card is about, L puts it off.",
    done: isSignedOff,
  },
  {
    at: "panel",
    title: "Write the tables",
    text: "Every table is signed off. Open 4 Review and press Apply to all: each table is written to its own file.",
    done: ({ cards, order }) => order.length > 0 && order.every((asset) => isUpToDate(cards[asset])),
  },
  {
    at: "panel",
    title: "Look, then export",
    text: (project) =>
      `${tablesText(project)} Compare before and after as you like, then export the tables under Export. ` +
      "Press ? for all keys. You can undo everything.",
  },
];

/** step: of the mark that is shown, null while the tour is not; back: one came back to it, and stays till Next. */
export const useTour = create<{ step: number | null; back: boolean }>()(() => ({ step: null, back: false }));

export const startTour = (): void => useTour.setState({ step: 0, back: false });

export const endTour = (): void => useTour.setState({ step: null, back: false });

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
