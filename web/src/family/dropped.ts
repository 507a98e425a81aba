// The files in what was dropped or picked, folders with all that lies in them.
import type { Given } from "../store/adding";

export async function droppedFiles(data: DataTransfer): Promise<Given[]> {
  // entries must be taken before the event is over
  const entries = [...data.items].flatMap((item) => item.webkitGetAsEntry() ?? []);
  if (entries.length === 0) return [...data.files].map((file) => ({ path: file.name, file }));
  return (await Promise.all(entries.map(filesOf))).flat();
}

export function pickedFiles(files: FileList | null): Given[] {
  return [...(files ?? [])].map((file) => ({ path: file.webkitRelativePath || file.name, file }));
}

async function filesOf(entry: FileSystemEntry): Promise<Given[]> {
  if (entry instanceof FileSystemFileEntry) {
    const file = await new Promise<File>((good, bad) => entry.file(good, bad));
    return [{ path: entry.fullPath.replace(/^\//, ""), file }];
  }
  if (!(entry instanceof FileSystemDirectoryEntry)) return [];
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
