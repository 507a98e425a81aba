// Commands on the open asset, or those side by side: showing several, and taking them out of the family.
import { leaveOut, whyNotLeave } from "../store/members";
import { useProject } from "../store/project";
import { assetsInView, toggleSheet } from "../store/sheet";
import { useWorkspace } from "../store/workspace";
import { commandsOf, inStage, needs, unless } from "./command";

export const sheetCommands = commandsOf("Label", [
  {
    id: "sheet",
    title: "Label several assets side by side, or one alone again",
    keys: ["W"],
    enabled: inStage("label", needs("There is just one asset.", () => useProject.getState().order.length > 1)),
    run: toggleSheet,
  },
  {
    id: "sheet-leave",
    title: "Show the open asset alone",
    keys: ["Escape"],
    enabled: needs("One asset is shown, or Escape first leaves what is in hand.", hasNothingElse),
    run: toggleSheet,
  },
]);

/** Whether several assets are shown, and nothing is selected or in hand that Escape leaves first. */
function hasNothingElse(): boolean {
  const { sheet, selection, elsewhere, brush, tool } = useWorkspace.getState();
  return sheet.length > 0 && !selection.size && !elsewhere.size && brush === null && tool === "select";
}

const isAble = unless(() => whyNotLeave(assetsInView(useWorkspace.getState())));

export const memberCommands = commandsOf("Edit", [
  { id: "leave-out", title: "Leave this asset, or all side by side, out of the family", words: "remove exclude", enabled: isAble, run: () => leaveOut(assetsInView(useWorkspace.getState())) },
]);
