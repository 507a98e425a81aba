// Where the section plane is, and which side is out of sight.
import { beforeEach, describe, expect, it } from "vitest";
import { initialSection, sectionAlong, sectionFacing, sectionPlane, setSection, useSection } from "./section";

const BOX = [0, 0, 0, 2, 4, 6];
const plane = () => sectionPlane(BOX, useSection.getState());

beforeEach(() => useSection.setState(initialSection, true));

describe("the section plane", () => {
  it("is not there until it is switched on, and gone when it is off", () => {
    expect(plane()).toBeNull();
    setSection({ on: true });
    expect(plane()).toEqual({ normal: [1, 0, 0], at: 1 });
    setSection({ on: false });
    expect(plane()).toBeNull();
  });

  it("is in the middle at first, along each axis, with what is in front of it out of sight", () => {
    sectionAlong("y");
    expect(plane()).toEqual({ normal: [0, -1, 0], at: -2 });
    sectionAlong("z");
    expect(plane()).toEqual({ normal: [0, 0, 1], at: 3 });
    sectionFacing([0, -0.6, 0.8]);
    expect(plane()?.at).toBeCloseTo((-2.4 + 4.8) / 2);
  });

  it("goes from one end to the other, and no further", () => {
    sectionAlong("z");
    setSection({ share: 2 });
    expect(plane()?.at).toBe(6);
    setSection({ share: -1 });
    expect(plane()?.at).toBe(0);
  });

  it("stays where it is when it is flipped", () => {
    sectionAlong("z");
    setSection({ share: 0.25, flipped: true });
    expect(plane()).toEqual({ normal: [-0, -0, -1], at: -1.5 });
  });
});
