// Pictures that were fetched and decoded, by a worker that is begun with the first of them; the latest few hundred are
// kept.
import { getBlob } from "../server/http";
import { keepLatest } from "../store/once";
import { waitForFirstScene } from "../store/scenes";
import { useStart } from "../store/start";
import type { DecodeAnswer, DecodeRequest } from "./decoder.worker";
import type { IdMap } from "./idMap";
import { LatestFirstQueue } from "./latestFirstQueue";

const MOST = 400;
// a browser has six connections to a server: edits must not wait until pictures are drawn
const line = new LatestFirstQueue<IdMap>(3);
const kept = new Map<string, IdMap>();

/** A picture that is there already. */
export function findPicture(url: string): IdMap | null {
  const map = kept.get(url);
  if (map) keepLatest(kept, url, map, MOST);
  return map ?? null;
}

/** Fetches a picture, once for all that want it; the last that was asked for comes first. */
export const requestPicture = (url: string) => line.ask(url, () => fetchPicture(url));

async function fetchPicture(url: string): Promise<IdMap> {
  if (!useStart.getState().view) await waitForFirstScene();
  const map = await decodePicture(await getBlob(url));
  keepLatest(kept, url, map, MOST);
  return map;
}

type Settle = (map: IdMap | null) => void;

class Decoder {
  private readonly worker = new Worker(new URL("./decoder.worker.ts", import.meta.url), { type: "module" });
  private readonly open = new Map<number, Settle>();
  private last = 0;

  constructor() {
    this.worker.onmessage = ({ data }: MessageEvent<DecodeAnswer>) => this.settle(data.number, data.map);
    this.worker.onerror = () => [...this.open.keys()].forEach((number) => this.settle(number, null));
  }

  decode(bytes: Uint8Array<ArrayBuffer>): Promise<IdMap> {
    const asked: DecodeRequest = { number: ++this.last, bytes };
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

/** Hands pictures to the worker that decodes them, which is begun with the first of them. */
export async function decodePicture(png: Blob): Promise<IdMap> {
  const bytes = new Uint8Array(await png.arrayBuffer());
  return (decoder ??= new Decoder()).decode(bytes);
}
