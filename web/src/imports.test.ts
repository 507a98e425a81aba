// Who may import whom: no circles, type-only imports counted, and folders import only from those listed before them.
import { globSync, readFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { describe, expect, it } from "vitest";

/** From the server's messages up to the window; what is not in a folder goes by its own name. */
const LAYERS = [
  "wire",
  "server",
  "store",
  "commands",
  "ui",
  "text",
  "pictures",
  "family",
  "hulls",
  "steps",
  "viewport",
  "panels",
  "start",
  "shell",
  "page",
  "main",
];

/** Layers inside the viewport. */
const VIEWPORT = ["camera", "geometry", "drawing", "stage", "pointer", "overlay", "toolbar"];

const SOURCE = import.meta.dirname;
const files = globSync("**/*.{ts,tsx}", { cwd: SOURCE }).filter((file) => !/\.test(-help)?\.ts/.test(file));
const imports = new Map(files.map((file) => [file, importedBy(file)]));

function importedBy(file: string): string[] {
  const text = readFileSync(join(SOURCE, file), "utf8");
  return [...text.matchAll(/(?:\bfrom|\bimport|new URL)\s*\(?\s*"(\.[^"]+)"/g)].flatMap(([, path = ""]) => {
    const target = join(dirname(file), path);
    return files.find((other) => [target, `${target}.ts`, `${target}.tsx`].includes(other)) ?? [];
  });
}

/** The files on a circle through a file, empty where there is none. */
function circleThrough(start: string): string[] {
  const before = new Map<string, string>();
  const queue = [start];
  for (const file of queue) {
    for (const next of imports.get(file) ?? []) {
      if (next === start) return pathTo(file, before);
      if (before.has(next)) continue;
      before.set(next, file);
      queue.push(next);
    }
  }
  return [];
}

function pathTo(file: string, before: ReadonlyMap<string, string>): string[] {
  const last = before.get(file);
  return last === undefined ? [file] : [...pathTo(last, before), file];
}

const layerOf = (file: string): string => file.split("/")[0]?.replace(/\.tsx?$/, "") ?? "";

/** Imports that go from a layer to a later one. */
function upward(layers: readonly string[], layer: (file: string) => string): string[] {
  return [...imports].flatMap(([file, targets]) => {
    const from = layers.indexOf(layer(file));
    const wrong = from < 0 ? [] : targets.filter((target) => layers.indexOf(layer(target)) > from);
    return wrong.map((target) => `${file} imports ${target}`);
  });
}

describe("imports of the page's modules", () => {
  it("are found", () => {
    expect(imports.get("main.tsx")).toContain("page.tsx");
    expect(imports.get("pictures/pictureCache.ts")).toContain("pictures/decoder.worker.ts");
  });

  it("go in no circle", () => {
    expect(files.map(circleThrough).filter((circle) => circle.length > 0)).toEqual([]);
  });

  it("know every folder", () => {
    expect([...new Set(files.map(layerOf))].filter((layer) => !LAYERS.includes(layer))).toEqual([]);
  });

  it("go down only", () => {
    expect(upward(LAYERS, layerOf)).toEqual([]);
    expect(upward(VIEWPORT, (file) => (layerOf(file) === "viewport" ? (file.split("/")[1] ?? "") : ""))).toEqual([]);
  });
});
