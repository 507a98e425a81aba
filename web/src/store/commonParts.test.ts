import { describe, expect, it } from "vitest";
import { findCommonParts, splitName } from "./commonParts";

const own = (...names: string[]) => {
  const partsOf = findCommonParts(names);
  return names.map((name) => splitName(name, partsOf(name)).slice(1, 3).join(""));
};

describe("what a name has alone", () => {
  it("is what its neighbours do not have, in whole words", () => {
    expect(own("chair_agam_0005.urdf", "chair_agne_0005.urdf", "chair_balser_0005.urdf")).toEqual(["agam", "agne", "balser"]);
    expect(own("0_part0_0", "0_part0_1", "0_part12_0")).toEqual(["0_0", "0_1", "12_0"]);
    expect(own("table_08.obj", "table_09.obj")).toEqual(["08", "09"]);
    expect(own("leg1", "leg2", "leg10")).toEqual(["1", "2", "10"]);
  });

  it("never is nothing", () => {
    expect(own("a_1", "a_1_2")).toEqual(["1", "1_2"]);
    expect(own("chair", "chair_2")).toEqual(["chair", "chair_2"]);
    expect(own("x.obj", "x.obj.obj")).not.toContain("");
    expect(own("alone_1.obj")).toEqual(["alone_1.obj"]);
    expect(own()).toEqual([]);
  });

  it("is found though one of the family is called quite otherwise", () => {
    expect(own("chair_agam_5.urdf", "chair_agne_5.urdf", "added/stool.obj")).toEqual(["agam", "agne", "added/stool.obj"]);
  });

  it("keeps its end apart where it is long, and all parts make up the name", () => {
    const parts = splitName("family_one_very_long_name_17.urdf", { head: 7, tail: 5 });
    expect(parts).toEqual(["family_", "one_very_long_na", "me_17", ".urdf"]);
    expect(parts.join("")).toBe("family_one_very_long_name_17.urdf");
  });
});

it("does not take long for ten thousand names", () => {
  const names = Array.from({ length: 10_000 }, (_, k) => `family/of/assets/chair_${k}_0005.urdf`);
  const begun = performance.now();
  expect(splitName(names[42] ?? "", findCommonParts(names)(names[42] ?? ""))[1]).toBe("42");
  expect(performance.now() - begun).toBeLessThan(1000);
});
