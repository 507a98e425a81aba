// The folders of this machine, as the server lists them: one is gone into, or chosen.
import { CornerLeftUp, Folder, FolderCheck, House } from "lucide-react";
import { Dialog } from "radix-ui";
import { type ComponentProps, type KeyboardEvent, useEffect, useEffectEvent, useRef, useState } from "react";
import { api } from "../server/api";
import { problemOf } from "../server/http";
import { useStart } from "../store/start";
import { countText } from "../store/words";
import { Button, IconButton } from "../ui/Button";
import { moveFocusBy } from "../ui/moveFocusBy";
import { Note } from "../ui/Section";
import type { FolderView } from "../wire";
import css from "./folders.module.css";

interface FolderButtonProps {
  title: string;
  /** Where to begin; the first of the usual places where it is empty or cannot be listed. */
  from: string;
  wants: "assets" | "project" | "place";
  onChoose: (folder: string) => void;
}

/** The button that opens the dialog. */
export function FolderButton({ title, from, wants, onChoose, ...button }: FolderButtonProps & ComponentProps<typeof Button>) {
  const [open, setOpen] = useState(false);
  return (
    <Dialog.Root open={open} onOpenChange={setOpen}>
      <Dialog.Trigger asChild>
        <Button {...button} />
      </Dialog.Trigger>
      <Dialog.Portal>
        <Dialog.Overlay className={css.shade} />
        <Dialog.Content className={css.dialog} aria-describedby={undefined} onOpenAutoFocus={focusField}>
          <Dialog.Title className={css.title}>{title}</Dialog.Title>
          <Folders from={from} wants={wants} onChoose={onChoose} onClose={() => setOpen(false)} />
        </Dialog.Content>
      </Dialog.Portal>
    </Dialog.Root>
  );
}

const BUTTONS = { assets: "Use this folder", project: "Open this project", place: "Put it in this folder" } as const;

function Folders({ from, wants, onClose, onChoose }: Omit<FolderButtonProps, "title"> & { onClose: () => void }) {
  const places = useStart((state) => state.view?.places ?? NONE);
  const { view, text, setText, problem, go } = useFolder(from, places);
  const list = useRef<HTMLUListElement>(null);
  const choose = (folder: string) => {
    onClose();
    onChoose(folder);
  };
  const fits = view !== null && (wants !== "project" || view.project);
  return (
    <>
      <form
        className={css.where}
        onSubmit={(event) => {
          event.preventDefault();
          void go(text);
        }}
      >
        <IconButton icon={CornerLeftUp} name="Up one folder" disabled={!view?.parent} onClick={() => view?.parent && void go(view.parent)} />
        {places.map((place, k) => (
          <IconButton key={place} icon={k ? House : FolderCheck} name={`Go to ${place}`} onClick={() => void go(place)} />
        ))}
        <input
          className={css.field}
          aria-label="Path of the folder"
          value={text}
          spellCheck={false}
          autoComplete="off"
          onChange={(event) => setText(event.target.value)}
        />
        <Button type="submit">Go</Button>
      </form>
      {problem && <Note mood="bad">{problem}</Note>}
      <ul ref={list} className={css.list} aria-label="Folders" onKeyDown={moveFocus}>
        {view?.entries.map(({ name, project }) => (
          <li key={name}>
            <button type="button" className={css.entry} onClick={() => void go(joinPath(view.folder, name)).then(() => focusFirst(list.current))}>
              {project ? <FolderCheck size={15} aria-hidden /> : <Folder size={15} aria-hidden />}
              <span className={css.name}>{name}</span>
              {project && <span className={css.badge}>project</span>}
            </button>
          </li>
        ))}
        {view?.entries.length === 0 && <li className={css.none}>No folders in here.</li>}
        {view !== null && view.more > 0 && <li className={css.none}>{countText(view.more, "more folder")}: type the path.</li>}
      </ul>
      <footer className={css.foot}>
        <span role="status">{view && describeFolder(view)}</span>
        <Button onClick={onClose}>Cancel</Button>
        <Button look="primary" disabled={!fits} onClick={() => view && choose(view.folder)}>
          {BUTTONS[wants]}
        </Button>
      </footer>
    </>
  );
}

const NONE: readonly string[] = [];

export function describeFolder({ project, files }: FolderView): string {
  if (project) return "This folder is a project.";
  return files ? `${countText(files, "asset or mesh file")} in this folder itself` : "";
}

export const joinPath = (folder: string, name: string): string => `${folder.replace(/\/$/, "")}/${name}`;

/** The folder that is listed, the path in the field, and going elsewhere. */
function useFolder(from: string, places: readonly string[]) {
  const [view, setView] = useState<FolderView | null>(null);
  const [text, setText] = useState(from);
  const [problem, setProblem] = useState<string | null>(null);
  const go = async (folder: string): Promise<boolean> => {
    try {
      const found = await api.listFolder(folder);
      setView(found);
      setText(found.folder);
      setProblem(null);
      return true;
    } catch (error) {
      const { where, message, remedy } = problemOf(error).problem;
      setProblem(`${where ? `${where}: ` : ""}${message}. ${remedy ?? ""}`.trim());
      return false;
    }
  };
  const begin = useEffectEvent(async () => {
    const [place] = places;
    if (from && (await go(from))) return;
    if (place !== undefined) await go(place);
  });
  useEffect(() => void begin(), []);
  return { view, text, setText, problem, go };
}

/** Puts the focus on the path, so that one can type at once. */
function focusField(event: Event): void {
  event.preventDefault();
  if (event.target instanceof Element) event.target.querySelector("input")?.focus();
}

/** Puts the focus on the first folder once it is there, or on the field above where there is none. */
function focusFirst(list: HTMLElement | null): void {
  setTimeout(() => (list?.querySelector("button") ?? list?.parentElement?.querySelector("input"))?.focus());
}

/** Arrow keys go through the folders. */
const moveFocus = (event: KeyboardEvent) => moveFocusBy(event, { ArrowDown: 1, ArrowUp: -1 }, "button");
