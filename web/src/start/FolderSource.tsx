// The folder of assets: typed, or picked in a list of the folders of this machine.
import { lookAtFolder, typeFolder, useStart } from "../store/start";
import { Button } from "../ui/Button";
import { FolderButton } from "./FolderDialog";
import css from "./start.module.css";

export function FolderSource() {
  const folder = useStart((state) => state.folder);
  const busy = useStart((state) => state.busy);
  const found = useStart((state) => state.found !== null);
  return (
    <form
      className={css.form}
      onSubmit={(event) => {
        event.preventDefault();
        void lookAtFolder();
      }}
    >
      <label htmlFor="assets-folder">Folder of assets</label>
      <div className={css.pathRow}>
        <input
          id="assets-folder"
          className={css.field}
          value={folder}
          placeholder="/home/me/cabinets"
          spellCheck={false}
          autoComplete="off"
          aria-describedby="assets-folder-note"
          onChange={(event) => typeFolder(event.target.value)}
        />
        <FolderButton title="Folder of assets" from={folder} wants="assets" onChoose={(chosen) => void lookAtFolder(chosen)} aria-label="Browse for the folder of assets">
          Browse…
        </FolderButton>
        <Button look={found ? "plain" : "primary"} type="submit" disabled={busy !== null || !folder.trim()}>
          {busy === "look" ? "Looking…" : "Look at it"}
        </Button>
      </div>
      <p className={css.dim} id="assets-folder-note">
        The assets stay where they are and are never written to.
      </p>
    </form>
  );
}
