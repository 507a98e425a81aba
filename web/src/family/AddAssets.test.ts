// Files that were picked or dropped, folders with all that lies in them.
import { describe, expect, it } from "vitest";
import { droppedFiles, pickedFiles } from "./AddAssets";

class FileEntry {
  readonly isFile = true;
  constructor(readonly fullPath: string) {}
  file(good: (file: File) => void): void {
    good(new File([], this.fullPath.split("/").at(-1) ?? ""));
  }
}

/** A folder whose entries the browser hands out a few at a time. */
class FolderEntry {
  readonly isDirectory = true;
  constructor(
    private readonly inside: readonly (FileEntry | FolderEntry)[],
    private readonly some = 100,
  ) {}
  createReader() {
    const left = [...this.inside];
    return { readEntries: (good: (entries: unknown[]) => void) => good(left.splice(0, this.some)) };
  }
}

const drop = (...entries: (FileEntry | FolderEntry | null)[]) =>
  ({ items: entries.map((entry) => ({ webkitGetAsEntry: () => entry })), files: [new File([], "plain.obj")] }) as unknown as DataTransfer;
const paths = async (data: DataTransfer) => (await droppedFiles(data)).map(({ path }) => path);

describe("what is dropped", () => {
  it("keeps where it lies in its folder", async () => {
    const folder = new FolderEntry([new FileEntry("/cab/robot.urdf"), new FolderEntry([new FileEntry("/cab/meshes/a.stl")])]);
    expect(await paths(drop(folder, new FileEntry("/one.obj")))).toEqual(["cab/robot.urdf", "cab/meshes/a.stl", "one.obj"]);
  });

  it("has all files of a large folder, though they come by the hundred", async () => {
    const files = Array.from({ length: 250 }, (_, k) => new FileEntry(`/many/${k}.obj`));
    expect(await paths(drop(new FolderEntry(files)))).toHaveLength(250);
  });

  it("is taken by its plain files where the browser knows no entries", async () => {
    expect(await paths(drop(null))).toEqual(["plain.obj"]);
  });
});

it("files that are picked have their path in the folder, or their name", () => {
  const inFolder = Object.assign(new File([], "a.stl"), { webkitRelativePath: "cab/a.stl" });
  const alone = Object.assign(new File([], "b.obj"), { webkitRelativePath: "" });
  expect(pickedFiles([inFolder, alone] as never).map(({ path }) => path)).toEqual(["cab/a.stl", "b.obj"]);
  expect(pickedFiles(null)).toEqual([]);
});
