// Hands pictures to the worker that decodes them, which is begun with the first of them.
import type { Answer, Asked } from "./decoder.worker";
import type { IdMap } from "./idmap";

type Settle = (map: IdMap | null) => void;

class Decoder {
  private readonly worker = new Worker(new URL("./decoder.worker.ts", import.meta.url), { type: "module" });
  private readonly open = new Map<number, Settle>();
  private last = 0;

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<Answer>) => this.settle(data.number, data.map);
    this.worker.onerror = () => [...this.open.keys()].forEach((number) => this.settle(number, null));
  }

  decode(bytes: Uint8Array<ArrayBuffer>): Promise<IdMap> {
    const asked: Asked = { number: ++this.last, bytes };
    const answer = new Promise<IdMap>((good, bad) => {
      this.open.set(asked.number, (map) => (map ? good(map) : bad(new Error("this picture cannot be read"))));
    });
    this.worker.postMessage(asked, [bytes.buffer]);
    return answer;
  }

  private settle(number: number, map: IdMap | null): void {
    this.open.get(number)?.(map);
    this.open.delete(number);
  }
}

let decoder: Decoder | undefined;

export async function decoded(png: Blob): Promise<IdMap> {
  const bytes = new Uint8Array(await png.arrayBuffer());
  return (decoder ??= new Decoder()).decode(bytes);
}
