import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import type { Event } from "../wire";
import { setToken } from "./http";
import { listen } from "./socket";

/** A socket whose other end is this test. */
class FakeSocket {
  static all: FakeSocket[] = [];
  onopen: (() => void) | null = null;
  onmessage: ((message: { data: string }) => void) | null = null;
  onclose: ((event: { code: number }) => void) | null = null;
  closed = false;

  constructor(
    readonly url: URL,
    readonly protocols: readonly string[],
  ) {
    FakeSocket.all.push(this);
  }

  close(code = 1006): void {
    this.closed = true;
    this.onclose?.({ code });
  }
}

const last = (): FakeSocket => FakeSocket.all.at(-1) as FakeSocket;
let heard: unknown[] = [];
let stop: () => void = () => undefined;

function start(): void {
  stop = listen({ receive: (event) => heard.push(event), lost: () => heard.push("lost") });
}

beforeEach(() => {
  vi.useFakeTimers();
  heard = [];
  FakeSocket.all = [];
  setToken("t");
  vi.stubGlobal("WebSocket", FakeSocket);
  vi.stubGlobal("document", { baseURI: "https://host:1/studio/" });
});

afterEach(() => {
  stop();
  vi.useRealTimers();
  vi.unstubAllGlobals();
});

describe("the connection to the server", () => {
  it("is made anew at once, and not called lost, where another project is opened", () => {
    start();
    last().onopen?.();
    last().onclose?.({ code: 4000 });
    expect([FakeSocket.all.length, heard]).toEqual([2, []]);
  });

  it("goes to the address of the page, encrypted where the page is", () => {
    start();
    expect(last().url.href).toBe("wss://host:1/studio/ws");
    expect(last().protocols).toEqual(["meshforge", "t"]);
    vi.stubGlobal("document", { baseURI: "http://host:1/" });
    start();
    expect(last().url.href).toBe("ws://host:1/ws");
  });

  it("hands events on in their order", () => {
    start();
    last().onopen?.();
    const events = [{ kind: "project" }, { kind: "history" }] as unknown as Event[];
    for (const event of events) last().onmessage?.({ data: JSON.stringify(event) });
    expect(heard).toEqual(events);
  });

  it("is made again by itself once it is lost", () => {
    start();
    last().onopen?.();
    last().onclose?.({ code: 1006 });
    expect(heard).toEqual(["lost"]);
    vi.advanceTimersByTime(249);
    expect(FakeSocket.all).toHaveLength(1);
    vi.advanceTimersByTime(1);
    expect(FakeSocket.all).toHaveLength(2);
  });

  it("is tried less and less often, at least every four seconds", () => {
    start();
    const waits = [250, 500, 1000, 2000, 4000, 4000, 4000];
    for (const [k, wait] of waits.entries()) {
      last().onclose?.({ code: 1006 });
      vi.advanceTimersByTime(wait - 1);
      expect(FakeSocket.all).toHaveLength(k + 1);
      vi.advanceTimersByTime(1);
      expect(FakeSocket.all).toHaveLength(k + 2);
    }
  });

  it("is tried at once again after it was there", () => {
    start();
    for (const wait of [250, 500, 1000]) {
      last().onclose?.({ code: 1006 });
      vi.advanceTimersByTime(wait);
    }
    last().onopen?.();
    last().onclose?.({ code: 1006 });
    vi.advanceTimersByTime(250);
    expect(FakeSocket.all).toHaveLength(5);
  });

  it("stays closed once nobody listens any more", () => {
    start();
    stop();
    expect(last().closed).toBe(true);
    vi.advanceTimersByTime(10_000);
    expect(FakeSocket.all).toHaveLength(1);
    expect(heard).toEqual([]);
  });

  it("is not made again where listening ends while it waits", () => {
    start();
    last().onclose?.({ code: 1006 });
    stop();
    vi.advanceTimersByTime(10_000);
    expect(FakeSocket.all).toHaveLength(1);
  });
});
