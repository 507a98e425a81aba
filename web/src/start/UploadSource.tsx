// Files for a new project: dropped anywhere on the page, or picked.
import { CloudUpload, File, Folder } from "lucide-react";
import { useRef } from "react";
import { Picker } from "../family/AddAssets";
import { uploadForProject, useStart } from "../store/start";
import { useUpload } from "../store/upload";
import { Button } from "../ui/Button";
import css from "./start.module.css";

export function UploadSource() {
  const files = useRef<HTMLInputElement>(null);
  const folder = useRef<HTMLInputElement>(null);
  const sending = useUpload((state) => state.sending !== null);
  const looking = useStart((state) => state.busy === "look");
  const off = sending || looking;
  return (
    <div className={css.drop}>
      <CloudUpload size={28} strokeWidth={1.3} aria-hidden />
      <p>
        Drop files or a folder onto this page: URDF, MJCF, SDF, GLB, OBJ, STL, PLY or VRML, with all files that they refer to.
        They are copied into the new project.
      </p>
      <div className={css.buttons}>
        <Button icon={Folder} disabled={off} onClick={() => folder.current?.click()}>
          Pick a folder…
        </Button>
        <Button icon={File} disabled={off} onClick={() => files.current?.click()}>
          Pick files…
        </Button>
      </div>
      <Picker input={files} name="Files for the project" take={uploadForProject} />
      <Picker input={folder} name="Folder for the project" folder take={uploadForProject} />
    </div>
  );
}
