// The command that shows several assets side by side.
import { useProject } from "../store/project";
import { toggleSheet } from "../store/sheet";
import { useWorkspace } from "../store/workspace";
import type { Command } from "./command";

export const sheetCommands: readonly Command[] = [
  {
    id: "sheet",
    title: "Label several assets side by side, or one alone again",
    group: "Label",
    keys: ["W"],
    enabled: () => useWorkspace.getState().stage === "label" && useProject.getState().order.length > 1,
    run: toggleSheet,
  },
  {
    id: "sheet-leave",
    title: "Show the open asset alone",
    group: "Label",
    keys: ["Escape"],
    enabled: hasNothingElse,
    run: toggleSheet,
  },
];

/** Whether several assets are shown, and nothing is selected or in hand that Escape leaves first. */
function hasNothingElse(): boolean {
  const { sheet, selection, elsewhere, brush, tool } = useWorkspace.getState();
  return sheet.length > 0 && !selection.size && !elsewhere.size && brush === null && tool === "select";
}
