// Short messages at the edge of the window: what was done, with undo, and what went wrong, with the remedy.
import { create } from "zustand";
import { ServerProblem } from "../server/http";
import type { Problem } from "../wire";

export interface Toast {
  id: number;
  kind: "done" | "problem";
  text: string;
  remedy: string | null;
  /** Whether undo is offered. */
  undo: boolean;
}

export const useToasts = create<{ toasts: readonly Toast[] }>()(() => ({ toasts: [] }));

let count = 0;

export function notify(text: string, undo = false): void {
  add({ id: ++count, kind: "done", text, remedy: null, undo });
}

export function reportProblem(problem: Problem): void {
  const text = problem.where ? `${problem.where}: ${problem.message}` : problem.message;
  add({ id: ++count, kind: "problem", text, remedy: problem.remedy, undo: false });
}

/** Tells of any error; one that is no answer of the server is a fault of the page. */
export function reportError(error: unknown): void {
  if (error instanceof ServerProblem) return reportProblem(error.problem);
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
