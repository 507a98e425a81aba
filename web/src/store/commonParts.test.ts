import { describe, expect, it } from "vitest";
import { cutMiddle, findOwnParts, sentenceOf, wrapName } from "./commonParts";

const own = (...names: string[]) => names.map(findOwnParts(names));

describe("what a name has alone", () => {
  it.each([
    [["chair_A.gltf", "chair_A_wood.gltf", "chair_stool.gltf"], ["A", "A_wood", "stool"]],
    [["chair_agam_0005.urdf", "chair_agne_0005.urdf", "chair_balser_0005.urdf"], ["agam", "agne", "balser"]],
    [["o.benchmark_desk_0208", "o.benchmark_shelf_0208"], ["desk", "shelf"]],
    [["noviz_collision_1_top", "noviz_collision_12_leg"], ["1_top", "12_leg"]],
    [["chair_A#0", "chair_A#1", "chair_A#12"], ["#0", "#1", "#12"]],
    [["a/b/desk.obj", "a/b/shelf.obj"], ["desk", "shelf"]],
    [["0_part0_0", "0_part0_1", "0_part12_0"], ["0_0", "0_1", "12_0"]],
    [["table_08.obj", "table_09.obj"], ["08", "09"]],
    [["leg1", "leg2", "leg10"], ["1", "2", "10"]],
  ])("is what its neighbours do not have, in whole words: %s", (names, parts) => {
    expect(own(...names)).toEqual(parts);
  });

  it("never is nothing, and two never are one", () => {
    expect(own("a_1", "a_1_2")).toEqual(["1", "1_2"]);
    expect(own("chair", "chair_2")).toEqual(["chair", "chair_2"]);
    expect(own("x.obj", "x.obj.obj")).not.toContain("");
    expect(own("chair_x", "chair_y", "x")).toEqual(["chair_x", "chair_y", "x"]);
    expect(own("chair_1", "chair_2", "desk_1", "desk_2")).toEqual(["chair_1", "chair_2", "desk_1", "desk_2"]);
    expect(own("alone_1.obj")).toEqual(["alone_1.obj"]);
    expect(own()).toEqual([]);
  });

  it("is found though one of the family is called quite otherwise", () => {
    expect(own("chair_agam_5.urdf", "chair_agne_5.urdf", "added/stool.obj")).toEqual(["agam", "agne", "added/stool.obj"]);
    expect(own("chair_A.gltf", "chair_B.gltf", "stool.gltf")).toEqual(["A", "B", "stool"]);
  });
});

it("a name that does not fit is cut in its middle", () => {
  expect(cutMiddle("nightstand_moppdp", 9)).toBe("nigh…ppdp");
  expect(cutMiddle("stool", 5)).toBe("stool");
  expect(["hannes_0529", "nightstand_17", "benchmark_of_a_nightstand", "stool"].map((name) => wrapName(name, 9))).toEqual(["hannes_\u200b0529", "nightstan\u200bd_17", "benchmark\u200b…ghtstand", "stool"]);
});

it("does not take long for ten thousand names", () => {
  const names = Array.from({ length: 10_000 }, (_, k) => `family/of/assets/chair_${k}_0005.urdf`);
  const begun = performance.now();
  expect(findOwnParts(names)(names[42] ?? "")).toBe("42");
  expect(performance.now() - begun).toBeLessThan(1000);
});

it("sentences say short names of assets whole, and long ones without what all share", () => {
  const names = ["set/chair_agam.obj", "set/partnet_mobility_cabinet_45162_collision.urdf", "set/partnet_mobility_cabinet_45162_collision.urdf.obj"];
  expect(sentenceOf(`Is ${names[0]} like ${names[1]}, or ${names[2]}?`, names, (name) => `<${names.indexOf(name)}>`)).toBe("Is chair_agam.obj like <1>, or <2>?");
});
