// Files dropped anywhere on the window become assets; the way there is shown.
import { CloudUpload } from "lucide-react";
import { useEffect, useState } from "react";
import { addAssets, stopAdding, useAdding } from "../store/adding";
import { complainedOf } from "../store/toasts";
import { Button } from "../ui/Button";
import css from "./adding.module.css";
import { droppedFiles } from "./dropped";

export function Adding() {
  const over = useDropped();
  const sending = useAdding((state) => state.sending);
  return (
    <>
      {over && (
        <div className={css.zone} aria-hidden>
          <div className={css.frame}>
            <CloudUpload size={32} />
            <b>Drop to add to the family</b>
            <span>Files or folders: URDF, MJCF, SDF, GLB, OBJ, STL, PLY or VRML, with all files that they name</span>
          </div>
        </div>
      )}
      {sending && (
        <div className={css.sending} role="status">
          <span className={css.path}>
            Adding file {sending.done + 1} of {sending.total}: {sending.path}
          </span>
          <progress value={sending.done} max={sending.total} aria-label="Files sent" />
          <Button onClick={stopAdding}>Stop</Button>
        </div>
      )}
    </>
  );
}

/** Whether files hover over the window; those that are dropped are added, unless a part took them itself. */
function useDropped(): boolean {
  const [over, setOver] = useState(false);
  useEffect(() => {
    const hasFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
    const drag = (event: DragEvent) => {
      if (!hasFiles(event)) return;
      setOver(!event.defaultPrevented);
      event.preventDefault();
    };
    const leave = (event: DragEvent) => event.relatedTarget === null && setOver(false);
    const drop = (event: DragEvent) => {
      setOver(false);
      if (!hasFiles(event) || event.defaultPrevented || !event.dataTransfer) return;
      event.preventDefault();
      droppedFiles(event.dataTransfer).then(addAssets).catch(complainedOf);
    };
    window.addEventListener("dragover", drag);
    window.addEventListener("dragleave", leave);
    window.addEventListener("drop", drop);
    return () => {
      window.removeEventListener("dragover", drag);
      window.removeEventListener("dragleave", leave);
      window.removeEventListener("drop", drop);
    };
  }, []);
  return over;
}
