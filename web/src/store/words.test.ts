import { describe, expect, it } from "vitest";
import { changeText, countText, errorParts, listText, shortName } from "./words";

describe("words", () => {
  it("counts one and many", () => {
    expect([countText(1, "hull"), countText(0, "hull"), countText(1200, "hull")]).toEqual(["1 hull", "0 hulls", "1,200 hulls"]);
  });

  it("lists all of a few, and of many the first ones", () => {
    expect(listText([])).toBe("");
    expect(listText(["a", "b"])).toBe("a and b");
    expect(listText(["a", "b", "c", "d", "e"])).toBe("a, b, c, d and e");
    expect(listText(["a", "b", "c", "d", "e", "f"])).toBe("a, b, c, d and 2 more");
  });

  it("shortens an asset to its last part", () => {
    expect(shortName("a/b/c.urdf")).toBe("c.urdf");
    expect(shortName("c.urdf")).toBe("c.urdf");
  });

  it("writes a change with its sign", () => {
    expect([changeText(10, 12), changeText(10, 9.95), changeText(10, 10), changeText(0, 3)]).toEqual([
      "+20 %",
      "−0.5 %",
      "±0 %",
      null,
    ]);
  });

  it("takes an error apart, and leaves the asset's own path out", () => {
    const error = "/some/where/a/b.urdf: there is no leg\n  Label it.";
    expect(errorParts(error, "a/b.urdf")).toEqual({ message: "there is no leg", remedy: "Label it." });
    expect(errorParts("it is broken", "b.urdf")).toEqual({ message: "it is broken", remedy: null });
    expect(errorParts("rule 2 of b.urdf: broken", "b.urdf").message).toBe("rule 2 of b.urdf: broken");
  });
});
