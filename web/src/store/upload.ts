// Adding assets: files go to the server one by one, then the server takes those that it can read.
import { create } from "zustand";
import { api } from "../server/api";
import { ServerProblem } from "../server/http";
import { sendAfterEdits } from "./edits";
import { notify, reportError, reportProblem } from "./toasts";

/** A file, and where it lies in the folder that was given: `cabinets/a/robot.urdf`. */
export interface PlacedFile {
  path: string;
  file: Blob;
}

interface UploadState {
  /** What is being sent; null while nothing is. */
  sending: { done: number; total: number; path: string } | null;
  stopped: boolean;
}

export const useUpload = create<UploadState>()(() => ({ sending: null, stopped: false }));

export const stopUpload = (): void => useUpload.setState({ stopped: true });

type SendFile = (path: string, file: Blob) => Promise<unknown>;

/** Sends files and has them taken as assets; notifies what came of it. */
export const addAssets = (given: readonly PlacedFile[]): Promise<void> => sendFiles(given, api.stageAssetFile, takeAll);

/** Whether files are on their way; then it is said that others have to wait. */
export function isSending(): boolean {
  const is = useUpload.getState().sending !== null;
  if (is) notify("Other files are being added. Add these when they are done.");
  return is;
}

/** Sends files one by one, then does what follows, unless it was stopped or none arrived; notifies what goes wrong. */
export async function sendFiles(
  given: readonly PlacedFile[],
  send: SendFile,
  then: () => Promise<unknown>,
): Promise<void> {
  if (isSending()) return;
  const files = given.filter(({ path }) => !isHidden(path));
  if (files.length === 0) return notify("There are no files to add.");
  useUpload.setState({ stopped: false });
  try {
    if (await sendAll(files, send)) await then();
  } finally {
    useUpload.setState({ sending: null });
  }
}

/** Whether all went well, or enough of it; one that is refused keeps no other from going. */
async function sendAll(files: readonly PlacedFile[], send: SendFile): Promise<boolean> {
  const refused: ServerProblem[] = [];
  for (const [done, { path, file }] of files.entries()) {
    if (useUpload.getState().stopped) {
      notify("Stopped: no asset was added.");
      return false;
    }
    useUpload.setState({ sending: { done, total: files.length, path } });
    try {
      await send(path, file);
    } catch (error) {
      if (!(error instanceof ServerProblem) || error.status === 0) {
        reportError(error);
        return false;
      }
      refused.push(error);
    }
  }
  const [first] = refused;
  if (first) reportProblem({ ...first.problem, message: withCount(first.problem.message, refused.length) });
  return refused.length < files.length;
}

function withCount(message: string, count: number): string {
  if (count === 1) return message;
  return `${message} (and ${count === 2 ? "1 more file" : `${count - 1} more files`})`;
}

const unreadText = (first: string, count: number) =>
  count === 1 ? `One asset was left out: ${first}` : `${count} assets were left out; the first: ${first}`;

function takeAll(): Promise<boolean> {
  return sendAfterEdits(async () => {
    const { names, problems = [] } = await api.takeAssets();
    notify(names.length === 1 ? `Added ${names[0]}.` : `Added ${names.length} assets.`, true);
    const [first] = problems;
    if (first !== undefined) reportProblem({ where: null, message: unreadText(first, problems.length), remedy: "Send it again, together with all files that it names.", conflict: false });
  });
}

/** Files of the system, which lie beside what a person means: `.DS_Store`, `__MACOSX/…`. */
const isHidden = (path: string) => path.split("/").some((part) => part.startsWith(".") || part === "__MACOSX");
