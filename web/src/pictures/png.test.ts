// PNGs of the server, byte for byte.
import { deflateSync } from "node:zlib";
import { expect, test } from "vitest";
import { readPng } from "./png";

const chunk = (kind: string, data: Uint8Array) => {
  const head = new Uint8Array(8);
  new DataView(head.buffer).setUint32(0, data.length);
  head.set([...kind].map((letter) => letter.charCodeAt(0)), 4);
  return [...head, ...data, 0, 0, 0, 0];
};

/** rows: each with its filter in front. */
function png(width: number, rows: number[][], bits = 8): Uint8Array<ArrayBuffer> {
  const header = new Uint8Array(13);
  const view = new DataView(header.buffer);
  view.setUint32(0, width);
  view.setUint32(4, rows.length);
  header.set([bits, 6, 0, 0, 0], 8);
  const data = deflateSync(new Uint8Array(rows.flat()));
  // in two parts, as encoders may do
  const parts = [data.subarray(0, 5), data.subarray(5)].flatMap((part) => chunk("IDAT", part));
  return new Uint8Array([137, 80, 78, 71, 13, 10, 26, 10, ...chunk("IHDR", header), ...parts, ...chunk("IEND", new Uint8Array())]);
}

test("every filter of a row is taken back", async () => {
  const { width, height, data } = await readPng(
    png(2, [
      [0, 1, 2, 3, 4, 5, 6, 7, 8],
      [1, 10, 20, 30, 40, 1, 1, 1, 1],
      [2, 1, 1, 1, 1, 250, 250, 250, 250],
      [3, 10, 10, 10, 10, 0, 0, 0, 0],
      [4, 1, 1, 1, 1, 1, 1, 1, 1],
    ]),
  );
  expect([width, height]).toEqual([2, 5]);
  expect([...data]).toEqual([
    ...[1, 2, 3, 4, 5, 6, 7, 8],
    ...[10, 20, 30, 40, 11, 21, 31, 41],
    ...[11, 21, 31, 41, 5, 15, 25, 35],
    ...[15, 20, 25, 30, 10, 17, 25, 32],
    ...[16, 21, 26, 31, 11, 18, 27, 33],
  ]);
});

test("colour under a pixel that is hardly covered is not rounded", async () => {
  const { data } = await readPng(png(1, [[0, 1, 37, 200, 3]]));
  expect([...data]).toEqual([1, 37, 200, 3]);
});

test("what is no such PNG is refused", async () => {
  await expect(readPng(new Uint8Array([1, 2, 3]))).rejects.toThrow("no PNG");
  await expect(readPng(png(1, [[0, 1, 2, 3, 4]], 16))).rejects.toThrow("another kind");
});
