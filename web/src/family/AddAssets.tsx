// Adding assets from files or folders: picked in a menu, or dropped anywhere on the window.
import { CloudUpload, Plus } from "lucide-react";
import { type RefObject, useEffect, useRef, useState } from "react";
import { addAssets, type PlacedFile, stopUpload, useUpload } from "../store/upload";
import { Button } from "../ui/Button";
import { Menu } from "../ui/Menu";
import { useCalled } from "../store/calls";
import css from "./adding.module.css";

export function AddMenu({ words = "Add" }: { words?: string }) {
  const files = useRef<HTMLInputElement>(null);
  const folder = useRef<HTMLInputElement>(null);
  const button = useRef<HTMLButtonElement>(null);
  useCalled("add", () => button.current?.focus());
  return (
    <>
      <Menu
        trigger={
          <Button ref={button} look={words === "Add" ? "quiet" : "primary"} icon={Plus} aria-label="Add assets">
            {words}
          </Button>
        }
        lines={[
          { label: "A folder of assets…", onSelect: () => folder.current?.click() },
          { label: "Files…", onSelect: () => files.current?.click() },
        ]}
      />
      <Picker input={files} name="Files to add" />
      <Picker input={folder} name="Folder to add" folder />
    </>
  );
}

interface PickerProps {
  input: RefObject<HTMLInputElement | null>;
  name: string;
  folder?: boolean;
  take?: (files: readonly PlacedFile[]) => Promise<void>;
}

/** The browser's own dialog for files, or for a folder with all that lies in it. */
export function Picker({ input, name, folder = false, take = addAssets }: PickerProps) {
  return (
    <input
      ref={(element) => {
        input.current = element;
        if (element) element.webkitdirectory = folder;
      }}
      type="file"
      multiple
      hidden
      aria-label={name}
      onChange={(event) => {
        void take(pickedFiles(event.target.files));
        event.target.value = "";
      }}
    />
  );
}

interface DropZoneProps {
  words?: string;
  /** What becomes of the files; the same function each time. */
  take?: (files: readonly PlacedFile[]) => Promise<void>;
}

/** Files dropped anywhere on the window become assets; the way there is shown. */
export function DropZone({ words = "Drop to add to the family", take = addAssets }: DropZoneProps) {
  const over = useDrop(take);
  const sending = useUpload((state) => state.sending);
  return (
    <>
      {over && (
        <div className={css.zone} aria-hidden>
          <div className={css.frame}>
            <CloudUpload size={32} />
            <b>{words}</b>
            <span>Files or folders: URDF, MJCF, SDF, GLB, OBJ, STL, PLY or VRML, with all files that they refer to</span>
          </div>
        </div>
      )}
      {sending && (
        <div className={css.sending} role="status">
          <span className={css.path}>
            Adding file {sending.done + 1} of {sending.total}: {sending.path}
          </span>
          <progress value={sending.done} max={sending.total} aria-label="Files sent" />
          <Button onClick={stopUpload}>Stop</Button>
        </div>
      )}
    </>
  );
}

/** Whether files hover over the window; those that are dropped are added, unless a part took them itself. */
function useDrop(take: (files: readonly PlacedFile[]) => Promise<void>): boolean {
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
      void droppedFiles(event.dataTransfer).then(take);
    };
    const stop = new AbortController();
    const { signal } = stop;
    window.addEventListener("dragover", drag, { signal });
    window.addEventListener("dragleave", leave, { signal });
    window.addEventListener("drop", drop, { signal });
    return () => stop.abort();
  }, [take]);
  return over;
}

/** The files in what was dropped or picked, folders with all that lies in them. */
export async function droppedFiles(data: DataTransfer): Promise<PlacedFile[]> {
  // entries must be taken before the event is over
  const entries = [...data.items].flatMap((item) => item.webkitGetAsEntry() ?? []);
  if (entries.length === 0) return [...data.files].map((file) => ({ path: file.name, file }));
  return (await Promise.all(entries.map(filesOf))).flat();
}

export function pickedFiles(files: FileList | null): PlacedFile[] {
  return [...(files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

// Chromium has no constructors of that name that one could ask by `instanceof`
const isFile = (entry: FileSystemEntry): entry is FileSystemFileEntry => entry.isFile;
const isFolder = (entry: FileSystemEntry): entry is FileSystemDirectoryEntry => entry.isDirectory;

async function filesOf(entry: FileSystemEntry): Promise<PlacedFile[]> {
  if (isFile(entry)) {
    const file = await new Promise<File>((good, bad) => entry.file(good, bad));
    return [{ path: entry.fullPath.replace(/^\//, ""), file }];
  }
  if (!isFolder(entry)) return [];
  const inside = await Promise.all((await entriesOf(entry.createReader())).map(filesOf));
  return inside.flat();
}

/** All entries of a folder; the browser hands them out by the hundred. */
async function entriesOf(reader: FileSystemDirectoryReader): Promise<FileSystemEntry[]> {
  const all: FileSystemEntry[] = [];
  for (;;) {
    const some = await new Promise<FileSystemEntry[]>((good, bad) => reader.readEntries(good, bad));
    if (some.length === 0) return all;
    all.push(...some);
  }
}
