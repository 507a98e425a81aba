// The window of a project without assets: what to do.
import { FolderPlus } from "lucide-react";
import { AddMenu } from "../family/AddMenu";
import { useProject } from "../store/project";
import css from "./nothing.module.css";

export function Nothing() {
  const broken = useProject((state) => state.order.length);
  const folder = useProject((state) => state.project.folder);
  const reading = useProject((state) => state.jobs.some((job) => job.kind === "read" && job.state === "running"));
  if (reading) {
    return (
      <main className={css.nothing}>
        <p role="status">Reading the assets…</p>
      </main>
    );
  }
  return (
    <main className={css.nothing} data-part>
      <FolderPlus size={40} strokeWidth={1.2} aria-hidden />
      <h2>{broken ? "No asset can be read" : "No assets yet"}</h2>
      {broken > 0 && <p>On the left each card says what is wrong with its file, and what mends it.</p>}
      <p>
        Drop files or a folder onto this window: URDF, MJCF, SDF, GLB, OBJ, STL, PLY or VRML, with all files that they name.
        They are copied into the project.
      </p>
      <AddMenu words="Add assets" />
      <p className={css.small}>
        Project folder: <code>{folder}</code>
      </p>
    </main>
  );
}
