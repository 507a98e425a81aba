import { expect, test } from "vitest";
import { dot, plus, type Vec } from "../../store/vectors";
import { axesOf, interpolate, distanceOf, FIELD, lookFromSide, orbit, pan, type Pose, STANDARD, zoom } from "./pose";

const pose: Pose = { target: [1, 2, 3], azimuth: 0.4, elevation: 0.3, height: 2, shift: [0, 0] };
const near = (a: Vec, b: Vec) => a.forEach((value, k) => expect(value).toBeCloseTo(b[k] ?? NaN, 9));

/** Where a point is seen in perspective, in heights from the middle. */
function seen(p: Pose, point: Vec): readonly [number, number] {
  const { right, up, eye } = axesOf(p);
  const off = plus(point, p.target, -1);
  const depth = distanceOf(p) - dot(off, eye);
  const unit = 2 * Math.tan(FIELD / 2) * depth;
  return [dot(off, right) / unit, dot(off, up) / unit];
}

test("from the top x goes right and y goes up, as on a plan", () => {
  const { right, up } = axesOf(lookFromSide(pose, "top"));
  near(right, [1, 0, 0]);
  near(up, [0, 1, 0]);
});

test("from the front and from the right z goes up", () => {
  for (const side of ["front", "right", "back", "left"] as const) near(axesOf(lookFromSide(pose, side)).up, [0, 0, 1]);
});

test("the axes of the picture stand on each other from every standard side", () => {
  for (const side of Object.keys(STANDARD) as (keyof typeof STANDARD)[]) {
    const { right, up, eye } = axesOf(lookFromSide(pose, side));
    expect([dot(right, up), dot(up, eye), dot(eye, right)].map(Math.abs).every((value) => value < 1e-12)).toBe(true);
  }
});

test("orbiting never goes over the pole", () => {
  expect(orbit(pose, 0, 10).elevation).toBe(Math.PI / 2);
});

test("what is under the pointer stays there while zooming", () => {
  const { right, up } = axesOf(pose);
  const point = plus(plus(pose.target, right, 0.3 * pose.height), up, -0.2 * pose.height);
  const after = zoom(pose, 0.5, 0.3, -0.2, [0.01, 100]);
  expect(seen(pose, point)[0]).toBeCloseTo(0.3, 9);
  expect(seen(after, point)[0]).toBeCloseTo(0.3, 9);
  expect(seen(after, point)[1]).toBeCloseTo(-0.2, 9);
});

test("zooming at its limit moves nothing", () => {
  expect(zoom(pose, 0.5, 0.3, 0.3, [2, 100])).toEqual(pose);
});

test("panning to the right and back comes home", () => {
  near(pan(pan(pose, 0.3, 0.1), -0.3, -0.1).target, pose.target);
});

test("a move takes the shorter way round", () => {
  const a = { ...pose, azimuth: 3.1 };
  const b = { ...pose, azimuth: -3.1 };
  expect(Math.abs(interpolate(a, b, 0.5).azimuth)).toBeGreaterThan(3.1);
});
