import { Vector3 } from "three";
import { beforeEach, describe, expect, it, vi } from "vitest";
import type { Vec } from "../../store/vectors";
import { cornersOf, START } from "./pose";
import { CameraView } from "./view";

const BOX = [-1, -2, 0, 3, 1, 2];
const corners = cornersOf(BOX);

function viewOf(projection: "perspective" | "orthographic" = "perspective", width = 400, height = 300): CameraView {
  const view = new CameraView();
  view.bounds = BOX;
  view.projection = projection;
  view.resize(width, height);
  view.fit(corners, null);
  return view;
}

const pixel = (view: CameraView, point: Vec) => view.pixelOf(new Vector3(...point));

/** How far a line of sight passes by a point. */
function missBy({ from, along }: { from: Vec; along: Vec }, point: Vec): number {
  const off = new Vector3(...point).sub(new Vector3(...from));
  return off.addScaledVector(new Vector3(...along), -off.dot(new Vector3(...along))).length();
}

beforeEach(() => {
  vi.stubGlobal("matchMedia", () => ({ matches: false }));
});

describe.each(["perspective", "orthographic"] as const)("in %s projection", (projection) => {
  it("the line of sight through the pixel of a point passes through the point", () => {
    const view = viewOf(projection);
    for (const corner of corners) {
      const { x, y } = pixel(view, corner);
      expect(missBy(view.sightAt(x, y), corner)).toBeCloseTo(0, 4);
    }
  });

  it("fitting shows every point, and leaves little room", () => {
    for (const [width, height] of [[400, 300], [200, 600], [900, 200]] as const) {
      const view = viewOf(projection, width, height);
      const spots = corners.map((corner) => pixel(view, corner));
      for (const { x, y } of spots) {
        expect(x).toBeGreaterThanOrEqual(0);
        expect(x).toBeLessThanOrEqual(width);
        expect(y).toBeGreaterThanOrEqual(0);
        expect(y).toBeLessThanOrEqual(height);
      }
      const span = (axis: "x" | "y") => Math.max(...spots.map((s) => s[axis])) - Math.min(...spots.map((s) => s[axis]));
      expect(Math.max(span("x") / width, span("y") / height)).toBeGreaterThan(0.7);
    }
  });

  it("the point in the middle of the plane of the target stays under the pointer while zooming", () => {
    const view = viewOf(projection);
    const { target } = view.pose;
    const before = pixel(view, target);
    view.zoom(0.5, before.x, before.y);
    const after = pixel(view, target);
    expect(Math.hypot(after.x - before.x, after.y - before.y)).toBeCloseTo(0, 6);
  });

  it("a drag that pans moves the target with the pointer", () => {
    const view = viewOf(projection);
    const { target } = view.pose;
    const before = pixel(view, target);
    view.pan(30, -20);
    const after = pixel(view, target);
    expect([after.x - before.x, after.y - before.y].map((by) => Math.round(by * 1e6) / 1e6)).toEqual([30, -20]);
  });

  it("turning leaves the target in the middle", () => {
    const view = viewOf(projection);
    view.orbit(120, 45);
    const { x, y } = pixel(view, view.pose.target);
    expect([x, y].map(Math.round)).toEqual([200, 150]);
  });
});

describe("limits", () => {
  it("keep the camera from going through the asset, or losing it", () => {
    const view = viewOf();
    for (let k = 0; k < 100; k++) view.zoom(0.5, 200, 150);
    const nearest = view.pose.height;
    view.zoom(0.5, 200, 150);
    expect(view.pose.height).toBe(nearest);
    expect(nearest).toBeGreaterThan(0);
    for (let k = 0; k < 100; k++) view.zoom(2, 200, 150);
    expect(view.pose.height).toBeCloseTo(40 * view.radius, 6);
  });

  it("keep it from turning over the pole", () => {
    const view = viewOf();
    view.orbit(0, 10_000);
    expect(view.pose.elevation).toBeCloseTo(Math.PI / 2, 9);
    view.orbit(0, -20_000);
    expect(view.pose.elevation).toBeCloseTo(-Math.PI / 2, 9);
  });
});

describe("moves", () => {
  it("take a moment, and end where they should", () => {
    const view = viewOf();
    view.lookFrom("top", 10);
    expect(view.advance(10.1)).toBe(true);
    const halfway = view.pose.elevation;
    expect(halfway).toBeGreaterThan(START.elevation);
    expect(halfway).toBeLessThan(Math.PI / 2);
    expect(view.advance(10.3)).toBe(false);
    expect(view.pose.elevation).toBeCloseTo(Math.PI / 2, 9);
    expect(view.advance(10.4)).toBe(false);
  });

  it("are over at once where the person wants less motion", () => {
    vi.stubGlobal("matchMedia", () => ({ matches: true }));
    const view = viewOf();
    view.lookFrom("front", 10);
    expect(view.advance(10)).toBe(false);
    expect(view.pose.elevation).toBe(0);
  });

  it("end where the person takes the camera", () => {
    const view = viewOf();
    view.fit([[0, 0, 0]], 10);
    view.orbit(10, 0);
    const { pose } = view;
    expect(view.advance(10.1)).toBe(false);
    expect(view.pose).toBe(pose);
  });
});

describe("another size of the window", () => {
  it("shows as much from side to side where it becomes narrower", () => {
    const view = viewOf("orthographic", 240, 300);
    const wide = (one: CameraView) => one.pose.height * one.aspect;
    const before = wide(view);
    view.resize(120, 300);
    expect(wide(view)).toBeCloseTo(before, 9);
    view.resize(240, 300);
    expect(wide(view)).toBeCloseTo(before, 9);
  });

  it("changes nothing of what is seen while it is wide", () => {
    const view = viewOf("perspective", 600, 300);
    const { height } = view.pose;
    view.resize(900, 300);
    expect(view.pose.height).toBe(height);
  });
});

it("gives the same camera as long as nothing changes", () => {
  const view = viewOf();
  const camera = view.camera();
  const at = camera.position.clone();
  expect(view.camera().position).toEqual(at);
  view.orbit(50, 0);
  expect(view.camera().position.equals(at)).toBe(false);
});

it("sees all of the asset between near and far, also pulled apart", () => {
  for (const explode of [0, 1.4]) {
    const view = viewOf();
    view.explode = explode;
    const camera = view.camera();
    for (const corner of corners) {
      const depth = camera.position.distanceTo(new Vector3(...corner).multiplyScalar(1 + explode));
      expect(depth).toBeLessThan(camera.far);
    }
    expect(camera.near).toBeGreaterThan(0);
  }
});
