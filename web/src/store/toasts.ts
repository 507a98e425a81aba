// Short messages at the edge of the window: what was done, with undo, and what went wrong, with the remedy.
import { create } from "zustand";
import { answers, ServerProblem } from "../server/http";
import type { Problem } from "../wire";
import { useProject } from "./project";

export interface Toast {
  id: number;
  kind: "done" | "problem";
  text: string;
  remedy: string | null;
  /** Whether undo is offered. */
  undo: boolean;
  /** What went wrong, as `answers` has it: once it succeeds, the message goes. Any answer does where no server was there. */
  act: string | null;
}

/** problems: those of late with their time, also those that are not shown any more, the last one first. */
export const useToasts = create<{ toasts: readonly Toast[]; problems: readonly (Toast & { at: Date })[] }>()(() => ({ toasts: [], problems: [] }));
const MOST_PROBLEMS = 50;
const ANY = "any";
answers.add((act) => drop((toast) => toast.act === ANY || toast.act === act));
useProject.subscribe(({ project: { problem } }, { project: { problem: before } }) => {
  if (before && before !== problem) drop(({ text }) => before.startsWith(text));
});

function drop(isMended: (toast: Toast) => boolean): void {
  const { toasts } = useToasts.getState();
  if (toasts.some(isMended)) useToasts.setState({ toasts: toasts.filter((toast) => !isMended(toast)) });
}

let count = 0;

export function notify(text: string, undo = false): void {
  add({ id: ++count, kind: "done", text, remedy: null, undo, act: null });
}

export function reportProblem(problem: Problem, act: string | null = null): void {
  const text = problem.where ? `${problem.where}: ${problem.message}` : problem.message;
  const toast: Toast = { id: ++count, kind: "problem", text, remedy: problem.remedy, undo: false, act };
  useToasts.setState(({ toasts, problems }) => ({
    toasts: toasts.filter((one) => one.kind === "done" || one.text !== text), // said again, not twice
    problems: [{ ...toast, at: new Date() }, ...problems.filter((one) => one.text !== text)].slice(0, MOST_PROBLEMS),
  }));
  add(toast);
}

/** The message of a problem that was shown last. */
export const lastProblem = (): Toast | undefined => useToasts.getState().toasts.findLast(({ kind }) => kind === "problem");

/** Tells of any error; one that is no answer of the server is a fault of the page. */
export function reportError(error: unknown): void {
  if (error instanceof ServerProblem) return reportProblem(error.problem, error.status ? error.act : ANY);
  if (error instanceof DOMException && error.name === "AbortError") return;
  const message = error instanceof Error ? error.message : String(error);
  const remedy = "This is a bug in the studio. Reload the page: nothing is lost.";
  reportProblem({ message, where: null, remedy, conflict: false });
}

export function dismissToast(id: number): void {
  useToasts.setState(({ toasts }) => ({ toasts: toasts.filter((toast) => toast.id !== id) }));
}

function add(toast: Toast): void {
  // undo takes back the latest edit only, so only the latest message offers it
  const older = (one: Toast): Toast => (toast.undo ? { ...one, undo: false } : one);
  useToasts.setState(({ toasts }) => ({ toasts: [...toasts.slice(-3).map(older), toast] }));
}
