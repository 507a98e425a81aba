// What the left button does: one of four tools.
import { BoxSelect, Lasso, MousePointer2, Slice } from "lucide-react";
import { startCut } from "../../commands/demonstrating";
import { setTool, type Tool, useDesk } from "../../store/desk";
import { IconButton } from "../../ui/Button";
import { keyOf } from "./keys";
import css from "./toolbar.module.css";

const TAKES = "takes hulls that are seen inside, or are inside as a whole; Shift adds, Alt takes away";

export function Tools() {
  const tool = useDesk((desk) => desk.tool);
  const take = (next: Tool) => setTool(tool === next ? "select" : next);
  return (
    <div className={css.group} role="group" aria-label="Tools">
      <IconButton
        icon={MousePointer2}
        name="Select by clicks; Shift adds, Ctrl toggles; drags turn the view"
        on={tool === "select"}
        onClick={() => setTool("select")}
      />
      <IconButton
        icon={BoxSelect}
        name={`Box: ${TAKES}`}
        keys={keyOf("tool-box")}
        on={tool === "box"}
        onClick={() => take("box")}
      />
      <IconButton
        icon={Lasso}
        name={`Lasso: ${TAKES}`}
        keys={keyOf("tool-lasso")}
        on={tool === "lasso"}
        onClick={() => take("lasso")}
      />
      <IconButton
        icon={Slice}
        name="Cut a hull in two by a plane"
        keys="K"
        on={tool === "cut"}
        onClick={() => (tool === "cut" ? setTool("select") : startCut())}
      />
    </div>
  );
}
