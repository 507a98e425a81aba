
import { expect, test } from "vitest";
import { boxRegion, isInside, placesInside, type Region } from "./region";

const square = boxRegion([2, 2], [6, 6]);

/** A picture of places plus one: rows of digits. */
function picture(...rows: string[]): { places: Uint32Array; width: number; height: number } {
  return { places: new Uint32Array([...rows.join("")].map(Number)), width: rows[0]?.length ?? 0, height: rows.length };
}

test("a box drawn from any corner is the same box", () => {
  for (const region of [boxRegion([2, 2], [6, 6]), boxRegion([6, 6], [2, 2]), boxRegion([6, 2], [2, 6])]) {
    expect([isInside(region, [4, 4]), isInside(region, [7, 4]), isInside(region, [1, 4])]).toEqual([true, false, false]);
  }
});

test("a lasso that turns inwards misses what is in its bay", () => {
  const bay: Region = [[0, 0], [10, 0], [10, 10], [5, 2], [0, 10]];
  expect(isInside(bay, [5, 1])).toBe(true);
  expect(isInside(bay, [5, 8])).toBe(false);
});

test("what is seen in a region is found by its pixels, what is beside it is not", () => {
  const { places, width, height } = picture("11000300", "11000300", "00220000", "00220000", "00000000", "00000044");
  expect([...placesInside(boxRegion([0, 0], [3, 3]), places, width, height)].sort()).toEqual([0, 1]);
  expect([...placesInside(boxRegion([5, 0], [8, 6]), places, width, height)].sort()).toEqual([2, 3]);
});

test("a region that reaches beyond the picture takes what is in the picture", () => {
  const { places, width, height } = picture("1002", "0000");
  expect([...placesInside(boxRegion([-5, -5], [50, 50]), places, width, height)].sort()).toEqual([0, 1]);
});

test("nothing is seen in a region over the background", () => {
  const { places, width, height } = picture("00000000", "00000000", "00000000", "00000000", "00000000", "00000000", "00000000");
  expect(placesInside(square, places, width, height).size).toBe(0);
});
