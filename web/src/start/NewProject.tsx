// A new project: of a folder of this machine, of files that are dropped or picked, or of a bundled family.
import { FolderPlus } from "lucide-react";
import { chooseFamily, chooseSource, makeProject, type Source, typeProject, useStart } from "../store/start";
import { Button } from "../ui/Button";
import { Choice } from "../ui/fields";
import { FolderButton } from "./FolderDialog";
import { FolderSource } from "./FolderSource";
import { Found } from "./Found";
import { ProblemNote } from "./ProblemNote";
import css from "./start.module.css";
import { UploadSource } from "./UploadSource";
import { moveInto } from "./words";

const SOURCES: readonly { value: Source; label: string }[] = [
  { value: "folder", label: "A folder on this machine" },
  { value: "upload", label: "Files that you drop or pick" },
  { value: "family", label: "A bundled family" },
];

export function NewProject() {
  const source = useStart((state) => state.source);
  return (
    <section className={css.new} aria-labelledby="new-project">
      <header className={css.head}>
        <h2 id="new-project">New project</h2>
      </header>
      <div>
        <Choice name="Where the assets come from" value={source} options={SOURCES} onChange={chooseSource} />
      </div>
      {source === "folder" && <FolderSource />}
      {source === "upload" && <UploadSource />}
      {source === "family" && <Families />}
      <ProblemNote place="assets" />
      {source !== "family" && <Found />}
      <Destination />
    </section>
  );
}

const PICTURES = import.meta.glob<string>("./pictures/*.png", { eager: true, import: "default" });

function Families() {
  const families = useStart((state) => state.view?.families ?? []);
  const family = useStart((state) => state.family);
  return (
    <fieldset className={css.families}>
      <legend>Assets to try MeshForge on; they are written into the project</legend>
      {families.map(({ name, about }) => (
        <label key={name} className={css.family} data-on={name === family}>
          <input type="radio" name="family" checked={name === family} onChange={() => chooseFamily(name)} />
          <img src={PICTURES[`./pictures/${name}.png`]} alt="" />
          <span>
            <b>{name}</b> {about}
          </span>
        </label>
      ))}
    </fieldset>
  );
}

/** Where the project goes, and making it; there once it is known what it is made of. */
function Destination() {
  const ready = useStart((state) => state.source === "family" || state.found !== null);
  const project = useStart((state) => state.project);
  const busy = useStart((state) => state.busy);
  if (!ready) return null;
  return (
    <form
      className={css.form}
      onSubmit={(event) => {
        event.preventDefault();
        void makeProject();
      }}
    >
      <label htmlFor="project-folder">Project folder</label>
      <div className={css.pathRow}>
        <input
          id="project-folder"
          className={css.field}
          value={project}
          spellCheck={false}
          autoComplete="off"
          aria-describedby="project-folder-note"
          onChange={(event) => typeProject(event.target.value)}
        />
        <FolderButton
          title="Where the project goes"
          from={parentOf(project)}
          wants="place"
          onChoose={(folder) => typeProject(moveInto(folder, project))}
          aria-label="Browse for the place of the project"
        >
          Browse…
        </FolderButton>
      </div>
      <p className={css.dim} id="project-folder-note">
        A new folder, made for labels, demonstrations, the program and results.
      </p>
      <ProblemNote place="project" />
      <div>
        <Button look="primary" type="submit" icon={FolderPlus} disabled={busy !== null || !project.trim()}>
          {busy === "make" ? "Making the project…" : "Make the project"}
        </Button>
      </div>
    </form>
  );
}

const parentOf = (path: string): string => path.replace(/[/\\][^/\\]*$/, "");
