// Adding assets: files go to the server one by one, then the server takes those that it can read.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import { complained, complainedOf, told } from "./toasts";

/** A file, and where it lies in the folder that was given: `cabinets/a/robot.urdf`. */
export interface Given {
  path: string;
  file: Blob;
}

interface AddingState {
  /** What is being sent; null while nothing is. */
  sending: { done: number; total: number; path: string } | null;
  stopped: boolean;
}

export const useAdding = create<AddingState>()(() => ({ sending: null, stopped: false }));

export function stopAdding(): void {
  useAdding.setState({ stopped: true });
}

/** Sends files and has them taken as assets; tells what came of it. */
export async function addAssets(given: readonly Given[]): Promise<void> {
  if (useAdding.getState().sending) return told("Files are being added already; these can follow when they are there.");
  const files = given.filter(({ path }) => !hidden(path));
  if (files.length === 0) return told("There is no file in what was given.");
  useAdding.setState({ stopped: false });
  try {
    if (await sent(files)) await take();
  } finally {
    useAdding.setState({ sending: null });
  }
}

/** Whether all went well, or enough of it; one that is refused keeps no other from going. */
async function sent(files: readonly Given[]): Promise<boolean> {
  const refused: ServerProblem[] = [];
  for (const [done, { path, file }] of files.entries()) {
    if (useAdding.getState().stopped) {
      told("Stopped; nothing was added.");
      return false;
    }
    useAdding.setState({ sending: { done, total: files.length, path } });
    try {
      await api.stageAssetFile(path, file);
    } catch (error) {
      if (!(error instanceof ServerProblem) || error.status === 0) {
        complainedOf(error);
        return false;
      }
      refused.push(error);
    }
  }
  const [first] = refused;
  if (first) complained({ ...first.problem, message: several(first.problem.message, refused.length) });
  return refused.length < files.length;
}

function several(message: string, count: number): string {
  if (count === 1) return message;
  return `${message} (and ${count === 2 ? "1 more file" : `${count - 1} more files`})`;
}

async function take(): Promise<void> {
  try {
    const { names } = await api.takeAssets();
    told(names.length === 1 ? `Added ${names[0]}.` : `Added ${names.length} assets.`, true);
  } catch (error) {
    complainedOf(error);
  }
}

/** Files of the system, which lie beside what a person means: `.DS_Store`, `__MACOSX/…`. */
const hidden = (path: string) => path.split("/").some((part) => part.startsWith(".") || part === "__MACOSX");
