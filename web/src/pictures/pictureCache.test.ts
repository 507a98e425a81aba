// Pictures are fetched once, decoded by a worker, and kept.
import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { DecodeAnswer, DecodeRequest } from "./decoder.worker";
import type { IdMap } from "./idMap";

// pictures wait for the first asset to be shown, which it is here
vi.mock("../store/scenes", () => ({ waitForFirstScene: () => Promise.resolve() }));

/** A worker that answers when the test lets it. */
class FakeWorker {
  static all: FakeWorker[] = [];
  onmessage: ((event: { data: DecodeAnswer }) => void) | null = null;
  onerror: (() => void) | null = null;
  asked: DecodeRequest[] = [];

  constructor() {
    FakeWorker.all.push(this);
  }

  postMessage(request: DecodeRequest): void {
    this.asked.push(request);
    if (autoAnswer) queueMicrotask(() => this.answer(request.number));
  }

  answer(number: number, map: IdMap | null = mapOf(number)): void {
    this.onmessage?.({ data: { number, map } });
  }
}

const mapOf = (number: number): IdMap => ({ width: number, height: 1, data: new Uint8Array(4) });
let autoAnswer = true;
let fetched: string[] = [];

/** The module as a page has it that was just loaded. */
async function load() {
  vi.resetModules();
  return import("./pictureCache");
}

beforeEach(() => {
  autoAnswer = true;
  fetched = [];
  FakeWorker.all = [];
  vi.stubGlobal("Worker", FakeWorker);
  vi.stubGlobal("requestAnimationFrame", (draw: () => void) => draw());
  vi.stubGlobal("fetch", async (url: string) => (fetched.push(url), new Response(new Uint8Array([1, 2]), { status: url.includes("missing") ? 404 : 200 })));
});

afterEach(() => {
  vi.unstubAllGlobals();
});

describe("a picture", () => {
  it("is fetched once for all that want it, and is there at once from then on", async () => {
    const { findPicture, requestPicture } = await load();
    expect(findPicture("a.png")).toBeNull();
    const [one, other] = [requestPicture("a.png"), requestPicture("a.png")];
    expect(await one.result).toBe(await other.result);
    expect(fetched).toEqual(["a.png"]);
    expect(findPicture("a.png")).toBe(await one.result);
  });

  it("that is not there is a failure, and is not kept", async () => {
    const { findPicture, requestPicture } = await load();
    await expect(requestPicture("missing.png").result).rejects.toThrow("404");
    expect(findPicture("missing.png")).toBeNull();
  });

  it("that nobody wants any more is never fetched", async () => {
    autoAnswer = false;
    const { requestPicture } = await load();
    for (const name of ["1", "2", "3"]) void requestPicture(name).result;
    const fourth = requestPicture("4");
    fourth.drop();
    await vi.waitFor(() => expect(fetched).toEqual(["1", "2", "3"]));
    FakeWorker.all[0]?.asked.forEach(({ number }) => FakeWorker.all[0]?.answer(number));
    await new Promise((done) => setTimeout(done, 5));
    expect(fetched).not.toContain("4");
  });
});

describe("decoding", () => {
  it("is done by one worker, which is begun with the first picture", async () => {
    const { decodePicture } = await load();
    expect(FakeWorker.all).toHaveLength(0);
    await Promise.all([decodePicture(new Blob(["a"])), decodePicture(new Blob(["b"]))]);
    expect(FakeWorker.all).toHaveLength(1);
  });

  it("gives each picture its own answer, in whatever order they come", async () => {
    autoAnswer = false;
    const { decodePicture } = await load();
    const both = Promise.all([decodePicture(new Blob(["a"])), decodePicture(new Blob(["b"]))]);
    await vi.waitFor(() => expect(FakeWorker.all[0]?.asked).toHaveLength(2));
    FakeWorker.all[0]?.answer(2);
    FakeWorker.all[0]?.answer(1);
    expect((await both).map(({ width }) => width)).toEqual([1, 2]);
  });

  it("fails for bytes that are no picture, and for all where the worker breaks", async () => {
    autoAnswer = false;
    const { decodePicture } = await load();
    const bad = decodePicture(new Blob(["a"]));
    await vi.waitFor(() => expect(FakeWorker.all[0]?.asked).toHaveLength(1));
    FakeWorker.all[0]?.answer(1, null);
    await expect(bad).rejects.toThrow("cannot be read");
    const lost = decodePicture(new Blob(["b"]));
    await vi.waitFor(() => expect(FakeWorker.all[0]?.asked).toHaveLength(2));
    FakeWorker.all[0]?.onerror?.();
    await expect(lost).rejects.toThrow("cannot be read");
  });
});
