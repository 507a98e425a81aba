import { beforeEach, describe, expect, it, vi } from "vitest";
import type { CameraView } from "../camera/view";
import type { Stage } from "../stage/stage";
import { Gestures, type PointerTool } from "./gestures";

/** The element of the picture, a little off the corner of the window. */
class Holder extends EventTarget {
  setPointerCapture(): void {}
  getBoundingClientRect(): { left: number; top: number } {
    return { left: 10, top: 20 };
  }
}

interface Fields {
  x?: number;
  y?: number;
  button?: number;
  pointerId?: number;
  pointerType?: string;
  deltaY?: number;
  deltaMode?: number;
  altKey?: boolean;
  shiftKey?: boolean;
}

let holder: Holder;
let moves: unknown[][] = [];
let drag: { move: ReturnType<typeof vi.fn>; end: ReturnType<typeof vi.fn>; cancel: ReturnType<typeof vi.fn> };
let tool: { [name in keyof PointerTool]: ReturnType<typeof vi.fn> };

function send(kind: string, { x = 0, y = 0, ...rest }: Fields = {}): Event {
  const event = new Event(kind, { cancelable: true });
  Object.assign(event, { clientX: x + 10, clientY: y + 20, button: 0, pointerId: 1, pointerType: "mouse", deltaMode: 0, ...rest });
  holder.dispatchEvent(event);
  return event;
}

beforeEach(() => {
  vi.stubGlobal("WheelEvent", { DOM_DELTA_LINE: 1 });
  moves = [];
  const note = (name: string) => (...values: unknown[]) => moves.push([name, ...values]);
  const view = { orbit: note("orbit"), pan: note("pan"), zoom: note("zoom") } as unknown as CameraView;
  const stage = { moveCamera: (change: (one: CameraView) => void) => change(view), paneAt: () => ({ x: 0 }) } as unknown as Stage;
  drag = { move: vi.fn(), end: vi.fn(), cancel: vi.fn() };
  tool = { begin: vi.fn(() => null), click: vi.fn(), hover: vi.fn(), drawsRegion: vi.fn(() => false) };
  holder = new Holder();
  new Gestures(holder as never, stage, tool as never).listen();
});

describe("the left button", () => {
  it("clicks where it goes down and up in one place, in pixels of the picture", () => {
    send("pointerdown", { x: 50, y: 60 });
    send("pointermove", { x: 52, y: 61 });
    send("pointerup", { x: 52, y: 61 });
    expect(tool.click.mock.calls[0]?.[0]).toEqual([50, 60]);
    expect(moves).toEqual([]);
  });

  it("turns the camera where no tool takes the drag, and clicks nothing then", () => {
    send("pointerdown", { x: 50, y: 60 });
    send("pointermove", { x: 70, y: 60 });
    send("pointermove", { x: 75, y: 65 });
    send("pointerup", { x: 75, y: 65 });
    expect(moves).toEqual([
      ["orbit", 20, 0],
      ["orbit", 5, 5],
    ]);
    expect(tool.click).not.toHaveBeenCalled();
  });

  it("is the tool's where the tool takes it", () => {
    tool.begin.mockReturnValue(drag as never);
    send("pointerdown", { x: 0, y: 0 });
    send("pointermove", { x: 30, y: 0 });
    send("pointerup", { x: 30, y: 0 });
    expect(drag.move).toHaveBeenCalledWith([30, 0]);
    expect(drag.end).toHaveBeenCalledOnce();
    expect(moves).toEqual([]);
  });

  it("cancels the tool's drag where it was only a click", () => {
    tool.begin.mockReturnValue(drag as never);
    send("pointerdown");
    send("pointerup");
    expect([drag.cancel.mock.calls.length, drag.end.mock.calls.length, tool.click.mock.calls.length]).toEqual([1, 0, 1]);
  });

  it("turns with Alt, but for tools that take away with it", () => {
    tool.begin.mockReturnValue(drag as never);
    send("pointerdown", { altKey: true });
    send("pointermove", { x: 30, altKey: true });
    expect(moves).toEqual([["orbit", 30, 0]]);
    send("pointerup", { x: 30 });
    tool.drawsRegion.mockReturnValue(true as never);
    send("pointerdown", { altKey: true });
    expect(tool.begin).toHaveBeenCalledOnce();
  });
});

describe("the other buttons", () => {
  it.each([
    ["the right one pans", { button: 2 }, "pan"],
    ["the middle one turns", { button: 1 }, "orbit"],
    ["the middle one with Shift pans", { button: 1, shiftKey: true }, "pan"],
  ])("%s", (_, fields, move) => {
    send("pointerdown", fields);
    send("pointermove", { x: 12, y: 8 });
    expect(moves).toEqual([[move, 12, 8]]);
    send("pointerup", { x: 12, y: 8, ...fields });
    expect([tool.begin.mock.calls.length, tool.click.mock.calls.length]).toEqual([0, 0]);
  });

  it("open no menu of the browser", () => {
    expect(send("contextmenu").defaultPrevented).toBe(true);
  });
});

describe("the pointer without a button", () => {
  it("points, until it leaves", () => {
    send("pointermove", { x: 5, y: 6 });
    send("pointerleave");
    expect(tool.hover.mock.calls).toEqual([[[5, 6]], [null]]);
  });
});

describe("the wheel", () => {
  it("comes nearer towards the pointer when it turns away from the person", () => {
    const event = send("wheel", { x: 40, y: 30, deltaY: -100 });
    const [name, factor, x, y] = moves[0] ?? [];
    expect([name, x, y, event.defaultPrevented]).toEqual(["zoom", 40, 30, true]);
    expect(factor).toBeLessThan(1);
    send("wheel", { deltaY: 100 });
    expect(moves[1]?.[1]).toBeCloseTo(1 / Number(factor), 9);
  });

  it("takes lines for more than pixels, and no jump for more than it is", () => {
    send("wheel", { deltaY: 3, deltaMode: 1 });
    send("wheel", { deltaY: 3 });
    expect(Number(moves[0]?.[1])).toBeGreaterThan(Number(moves[1]?.[1]));
    send("wheel", { deltaY: 100_000 });
    expect(Number(moves[2]?.[1])).toBeLessThan(1.5);
  });
});

describe("two fingers", () => {
  const finger = (pointerId: number, x: number, y = 0): Fields => ({ pointerId, pointerType: "touch", x, y });

  it("move the picture with them, and come nearer when they go apart", () => {
    tool.begin.mockReturnValue(drag as never);
    send("pointerdown", finger(1, 100));
    send("pointerdown", finger(2, 200));
    expect(drag.cancel).toHaveBeenCalledOnce();
    send("pointermove", finger(2, 300));
    expect(moves).toEqual([
      ["pan", 50, 0],
      ["zoom", 0.5, 200, 0],
    ]);
  });

  it("click nothing when they are lifted", () => {
    send("pointerdown", finger(1, 100));
    send("pointerdown", finger(2, 200));
    send("pointerup", finger(1, 100));
    send("pointerup", finger(2, 200));
    expect(tool.click).not.toHaveBeenCalled();
  });
});

it("a drag that the browser takes over is cancelled", () => {
  tool.begin.mockReturnValue(drag as never);
  send("pointerdown");
  send("pointermove", { x: 30 });
  send("pointercancel");
  send("pointermove", { x: 60 });
  expect([drag.cancel.mock.calls.length, drag.move.mock.calls.length]).toEqual([1, 1]);
  expect(tool.hover).toHaveBeenCalledWith([60, 0]);
});
