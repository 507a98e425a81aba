import { afterEach, beforeEach, describe, expect, it, vi } from "vitest";
import { FrameRate } from "./frameRate";

/** Moves the camera for some frames that come so far apart [s]; the shares of the pixels that they are drawn with. */
function turn(rate: FrameRate, apart: number, frames: number, start = 100): number[] {
  return Array.from({ length: frames }, (_, k) => {
    const now = start + k * apart;
    rate.move(now);
    return rate.begin(now);
  });
}

beforeEach(() => {
  vi.useFakeTimers();
});

afterEach(() => {
  vi.useRealTimers();
});

describe("frames while the camera moves", () => {
  it("are drawn finely where drawing is fast", () => {
    expect(new Set(turn(new FrameRate(() => undefined), 0.016, 50))).toEqual(new Set([1]));
  });

  it("become coarse where drawing is slow", () => {
    const shares = turn(new FrameRate(() => undefined), 0.1, 10);
    expect(shares[0]).toBe(1);
    expect(shares.at(-1)).toBeLessThan(1);
  });

  it("become coarse on a processor however slow drawing is, and not as the person pauses", () => {
    expect(turn(new FrameRate(() => undefined, true), 0.6, 3).at(-1)).toBeLessThan(1);
    const rate = new FrameRate(() => undefined, true);
    const shares = [100, 101, 102].flatMap((now) => [...turn(rate, 0.016, 3, now), rate.begin(now + 0.3)]);
    expect(new Set(shares)).toEqual(new Set([1]));
  });

  it("are of the move, coarse and without shadows, however long after it they are drawn", () => {
    const rate = new FrameRate(() => undefined, true);
    const late = (now: number) => (rate.move(now), [rate.begin(now + 0.5), rate.hasTime(now + 0.5)]);
    expect([late(100), late(100.6), late(101.2)]).toEqual([[1, false], [0.5, false], [0.5, false]]);
    expect([rate.begin(101.9), rate.hasTime(101.9)]).toEqual([1, true]);
  });

  it("stay fine after a single slow one", () => {
    const rate = new FrameRate(() => undefined);
    turn(rate, 0.016, 20);
    rate.move(100.36);
    expect(rate.begin(100.36)).toBe(1);
    expect(turn(rate, 0.016, 20, 100.37).at(-1)).toBe(1);
  });

  it("are not slow because the person paused", () => {
    expect(new Set(turn(new FrameRate(() => undefined), 0.5, 20))).toEqual(new Set([1]));
  });
});

describe("a camera that rests", () => {
  it("is drawn finely again, for which it asks by itself", () => {
    const rested = vi.fn();
    const rate = new FrameRate(rested);
    turn(rate, 0.1, 10);
    expect(rested).not.toHaveBeenCalled();
    vi.advanceTimersByTime(200);
    expect(rested).toHaveBeenCalledOnce();
    expect(rate.begin(102)).toBe(1);
  });

  it("asks for nothing where it was drawn finely all the time", () => {
    const rested = vi.fn();
    turn(new FrameRate(rested), 0.016, 50);
    vi.advanceTimersByTime(1000);
    expect(rested).not.toHaveBeenCalled();
  });

  it("asks for nothing any more once the picture is gone", () => {
    const rested = vi.fn();
    const rate = new FrameRate(rested);
    turn(rate, 0.1, 10);
    rate.stop();
    vi.advanceTimersByTime(1000);
    expect(rested).not.toHaveBeenCalled();
  });
});

it("tries another asset finely at first", () => {
  const rate = new FrameRate(() => undefined);
  expect(turn(rate, 0.1, 10).at(-1)).toBeLessThan(1);
  rate.restart();
  expect(turn(rate, 0.016, 3, 200).at(-1)).toBe(1);
});

it("draws the first frame of another asset coarsely on a processor, and no other that is drawn quickly", () => {
  const rate = new FrameRate(() => undefined, true);
  rate.settle(100);
  expect([rate.begin(100.4), rate.begin(100.45), ...turn(rate, 0.016, 10, 200)]).toEqual([0.5, ...Array<number>(11).fill(1)]);
});

describe("time for shadows", () => {
  it("is there in every frame where drawing is fast", () => {
    const rate = new FrameRate(() => undefined);
    turn(rate, 0.016, 20);
    expect(rate.hasTime(100.32)).toBe(true);
  });

  it("is there as soon as the camera rests where drawing is slow, which then asks for a frame", () => {
    const rested = vi.fn();
    const rate = new FrameRate(rested);
    turn(rate, 0.1, 10);
    expect(rate.hasTime(100.91)).toBe(false);
    vi.advanceTimersByTime(200);
    expect(rested).toHaveBeenCalledOnce();
    expect(rate.hasTime(101.1)).toBe(true);
  });

  it("is not there in the first frame of another asset on a processor, but in the next", () => {
    const rested = vi.fn();
    const rate = new FrameRate(rested, true);
    rate.settle(100);
    expect(rate.hasTime(100.02)).toBe(false);
    vi.advanceTimersByTime(200);
    expect(rested).toHaveBeenCalledOnce();
    expect(rate.hasTime(100.17)).toBe(true);
  });

  it("is not there in a first frame that comes late either", () => {
    const rested = vi.fn();
    const rate = new FrameRate(rested, true);
    rate.settle(100);
    expect(rate.begin(100.5)).toBeLessThan(1);
    expect(rate.hasTime(100.5)).toBe(false);
    vi.advanceTimersByTime(200);
    expect(rested).toHaveBeenCalledOnce();
    expect([rate.begin(100.7), rate.hasTime(100.7)]).toEqual([1, true]);
  });
});
