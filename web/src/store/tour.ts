// The guided tour of the demo: its marks, and how far one is; knows no DOM.
import { create } from "zustand";
import { type DeskState, useDesk } from "./desk";
import { type ProjectState, useProject } from "./project";
import { useScenes } from "./scenes";

export interface TourMark {
  /** The part of the window that it points at: its `data-tour`. */
  at: "family" | "view" | "steps" | "panel" | "stages" | "hulls";
  title: string;
  text: string;
  /** Whether the person has done it; without, Next goes on. */
  done?: (project: ProjectState, desk: DeskState) => boolean;
}

/** Which labels the selected hulls have. */
function selectedLabels(desk: DeskState): ReadonlySet<string | null> {
  const { scene } = useScenes.getState();
  return new Set(scene?.hulls.filter((hull) => desk.selection.has(hull.name)).map((hull) => hull.label));
}

const demonstrated = (project: ProjectState) => Object.values(project.cards).filter((card) => card.demonstrated).length;
const only = (desk: DeskState, label: string) => {
  const labels = selectedLabels(desk);
  return labels.size === 1 && labels.has(label);
};

export const MARKS: readonly TourMark[] = [
  {
    at: "family",
    title: "A family of tables",
    text: "Each table is a set of convex hulls, and every hull has a label: that is its colour. You show on one table what is to be done; MeshForge learns it and does it to all.",
  },
  {
    at: "stages",
    title: "Four stages",
    text: "The labels are there already. Go on to 2 Demonstrate.",
    done: (_, desk) => desk.stage === "demonstrate",
  },
  {
    at: "view",
    title: "Pick the splinters",
    text: "Small hulls named misc are left over from cutting. Click one, then press Shift+L: all hulls with its label are selected.",
    done: (project, desk) => only(desk, "misc") || project.project.rules.length > 0,
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
    done: (project) => demonstrated(project) > 1,
  },
  {
    at: "panel",
    title: "What was learned",
    text: "Open 3 Learn: the program, a sentence for each rule. Point at a rule, and its hulls light up on all tables. If it asks something, choose the picture that is right.",
    done: (_, desk) => desk.stage === "review",
  },
  {
    at: "panel",
    title: "Do it to all",
    text: "In 4 Review, press Apply. Then look at before and after, accept what is right, and export.",
    done: (project) => Object.values(project.cards).some((card) => card.output === "edited"),
  },
  {
    at: "panel",
    title: "That is all",
    text: "Flag what is wrong, correct it by hand, or demonstrate it and the program learns. Press ? for all keys; undo takes anything back.",
  },
];

/** step: of the mark that is shown, null while the tour is not. */
export const useTour = create<{ step: number | null }>()(() => ({ step: null }));

export function beginTour(): void {
  useTour.setState({ step: 0 });
}

export function endTour(): void {
  useTour.setState({ step: null });
}

export function turnTour(by: 1 | -1): void {
  useTour.setState(({ step }) => {
    const next = (step ?? 0) + by;
    return { step: next >= MARKS.length ? null : Math.max(next, 0) };
  });
}

/** Goes on whenever the person has done what a mark asks for; until the returned function is called. */
export function followTour(): () => void {
  const look = () => {
    const { step } = useTour.getState();
    if (step !== null && MARKS[step]?.done?.(useProject.getState(), useDesk.getState())) turnTour(1);
  };
  const stops = [useProject.subscribe(look), useDesk.subscribe(look)];
  return () => stops.forEach((stop) => stop());
}
