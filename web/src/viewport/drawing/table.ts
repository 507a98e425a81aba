// A small texture that holds four bytes for each hull, so that a change of looks never touches geometry.
import { DataTexture, NearestFilter, RGBAFormat, SRGBColorSpace, UnsignedByteType } from "three";

export const WIDTH = 256;

export class Table {
  readonly texture: DataTexture;
  private readonly data: Uint8Array;

  /** colors: whether the first three bytes are a colour as the screen has it. */
  constructor(count: number, colors: boolean) {
    const rows = Math.max(1, Math.ceil(count / WIDTH));
    this.data = new Uint8Array(4 * WIDTH * rows);
    this.texture = new DataTexture(this.data, WIDTH, rows, RGBAFormat, UnsignedByteType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
    if (colors) this.texture.colorSpace = SRGBColorSpace;
    this.texture.needsUpdate = true;
  }

  set(k: number, r: number, g: number, b: number, a: number): void {
    this.data.set([r, g, b, a], 4 * k);
  }

  /** To be called once after a round of changes. */
  changed(): void {
    this.texture.needsUpdate = true;
  }

  dispose(): void {
    this.texture.dispose();
  }
}
