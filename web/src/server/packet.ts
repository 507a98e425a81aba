// Packets of shapes: a JSON header, then vertices and triangles of all of its rows.
import type { EditHeader, ShapeRow, ShapesHeader } from "../wire";

/** Triangles of one shape; positions: x, y, z of each vertex [m]; index: three vertices each. */
export interface Shape {
  readonly positions: Float32Array;
  readonly index: Uint32Array;
}

interface Packet<Header> {
  readonly header: Header;
  readonly rows: readonly ShapeRow[];
  readonly shapes: readonly Shape[];
}

export type ShapesPacket = Packet<ShapesHeader>;
export type EditedPacket = Packet<EditHeader>;

export function readPacket<Header extends { rows: ShapeRow[] }>(buffer: ArrayBuffer): Packet<Header> {
  const { header, end } = readHeader<Header>(buffer);
  const vertices = header.rows.reduce((sum, row) => sum + row.vertices, 0);
  let vertex = end;
  let face = vertex + 12 * vertices;
  const shapes = header.rows.map((row) => {
    const shape = {
      positions: new Float32Array(buffer, vertex, 3 * row.vertices),
      index: new Uint32Array(buffer, face, 3 * row.faces),
    };
    vertex += 12 * row.vertices;
    face += 12 * row.faces;
    return shape;
  });
  return { header, rows: header.rows, shapes };
}

/** A picture packet: names of hulls in order, and the PNG that shows their positions. */
export function readPicture(buffer: ArrayBuffer): { names: string[]; png: Blob } {
  const { header, end } = readHeader<{ names: string[] }>(buffer);
  return { names: header.names, png: new Blob([new Uint8Array(buffer, end)], { type: "image/png" }) };
}

function readHeader<Header>(buffer: ArrayBuffer): { header: Header; end: number } {
  const end = 4 + new DataView(buffer).getUint32(0, true);
  return { header: JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 4, end - 4))) as Header, end };
}
