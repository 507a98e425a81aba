import { expect, it } from "vitest";
import type { ShapesHeader } from "../wire";
import { readPacket, readPicture } from "./packet";

function packet(header: object, ...arrays: (Float32Array | Uint32Array)[]): ArrayBuffer {
  const text = JSON.stringify(header);
  const json = new TextEncoder().encode(text.padEnd(Math.ceil(text.length / 4) * 4));
  const bytes = new Uint8Array(4 + json.length + arrays.reduce((sum, array) => sum + array.byteLength, 0));
  new DataView(bytes.buffer).setUint32(0, json.length, true);
  bytes.set(json, 4);
  let at = 4 + json.length;
  for (const array of arrays) {
    bytes.set(new Uint8Array(array.buffer), at);
    at += array.byteLength;
  }
  return bytes.buffer;
}

it("takes each row's vertices and triangles from its own place", () => {
  const rows = [
    { name: "a", vertices: 1, faces: 0, rgba: null },
    { name: "b", vertices: 3, faces: 1, rgba: null },
  ];
  const vertices = Float32Array.from([9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0]);
  const { shapes } = readPacket<ShapesHeader>(packet({ rows }, vertices, Uint32Array.from([0, 1, 2])));
  expect([...(shapes[0]?.positions ?? [])]).toEqual([9, 9, 9]);
  expect(shapes[0]?.index).toHaveLength(0);
  expect([...(shapes[1]?.positions ?? [])]).toEqual([0, 0, 0, 1, 0, 0, 0, 1, 0]);
  expect([...(shapes[1]?.index ?? [])]).toEqual([0, 1, 2]);
});

it("splits a picture from the names of its hulls", async () => {
  const { names, png } = readPicture(packet({ names: ["a", "b"] }, Float32Array.from([1])));
  expect(names).toEqual(["a", "b"]);
  expect(png.size).toBe(4);
});
