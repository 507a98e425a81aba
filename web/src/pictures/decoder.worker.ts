// Decodes pictures beside the page, so that scrolling goes on meanwhile.
import { type IdMap, readIdMap } from "./idMap";

/** What the worker is asked, and what it answers; map: null where the bytes are no such picture. */
export interface DecodeRequest {
  readonly number: number;
  readonly bytes: Uint8Array<ArrayBuffer>;
}
export interface DecodeAnswer {
  readonly number: number;
  readonly map: IdMap | null;
}

/** The part of a worker's global scope that is used here; the page's types know it as a window. */
const page = self as unknown as {
  onmessage: (event: MessageEvent<DecodeRequest>) => void;
  postMessage(answer: DecodeAnswer, handedOver: ArrayBufferLike[]): void;
};

page.onmessage = ({ data: { number, bytes } }) => {
  try {
    const map = readIdMap(bytes);
    page.postMessage({ number, map }, [map.data.buffer]);
  } catch {
    page.postMessage({ number, map: null }, []);
  }
};
