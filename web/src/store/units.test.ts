// One unit of length everywhere, as it was chosen.
import { describe, expect, it } from "vitest";
import { figureText, lengthText, textIn, volumeText } from "./units";

describe("a figure", () => {
  it("has three digits, in the unit in which findings are told, however small", () => {
    expect(figureText(0.0397, "m", "m")).toBe("0.0397 m");
    expect(figureText(1.23456, "m", "m")).toBe("1.23 m");
    expect(figureText(0.558, "l", "m")).toBe("0.558 l");
    expect(figureText(0.00119, "l", "m")).toBe("0.00119 l");
    expect(figureText(12345, "l", "m")).toBe("12,300 l");
    expect(figureText(0.0424, "kg", "m")).toBe("0.0424 kg");
    expect(figureText(33.333, "%", "m")).toBe("33.3%");
    expect(figureText(180, "°", "m")).toBe("180°");
    expect(figureText(3, "", "m")).toBe("3");
  });

  it("is in millimetres and cubic centimetres where these were chosen, and else as it was", () => {
    expect(figureText(0.0397, "m", "mm")).toBe("39.7 mm");
    expect(figureText(0.558, "l", "mm")).toBe("558 cm³");
    expect(figureText(0.25, "m/s", "mm")).toBe("0.25 m/s");
  });

  it("says nothing of rounding, and of what is not known", () => {
    expect(figureText(2.3e-11, "m/s", "m")).toBe("0 m/s");
    expect(figureText(0, "l", "m")).toBe("0 l");
    expect(figureText(null, "m", "mm")).toBe("–");
  });
});

it("lengths and volumes keep one unit, whatever their size", () => {
  expect([2, 0.25, 0.0031].map((length) => lengthText(length, "m"))).toEqual(["2 m", "0.25 m", "0.0031 m"]);
  expect([2, 0.25, 0.0031].map((length) => lengthText(length, "mm"))).toEqual(["2,000 mm", "250 mm", "3.1 mm"]);
  expect([1.5, 0.0112, 3e-8].map((volume) => volumeText(volume, "m"))).toEqual(["1,500 l", "11.2 l", "0.00003 l"]);
  expect([0.0112, 3e-8].map((volume) => volumeText(volume, "mm"))).toEqual(["11,200 cm³", "0.03 cm³"]);
});

describe("a message of the server", () => {
  it("stays as it is in metres", () => {
    const text = "hulls stick out by 0.00927 m at most (cells of 0.01 m)";
    expect(textIn(text, "m")).toBe(text);
  });

  it.each([
    ["hulls stick out by 0.00927 m at most (cells of 0.01 m)", "hulls stick out by 9.27 mm at most (cells of 10 mm)"],
    ["convex_2 (0.013 m) and part 3 (5e-05 m): sticks out", "convex_2 (13 mm) and part 3 (0.05 mm): sticks out"],
    ["0.56 l about 0.1, -0.2, 0.3 (0.1 × 0.2 × 0.3 m): free", "560 cm³ about 100, -200, 300 (100 × 200 × 300 mm): free"],
    ["12 l closed, 0.5 l opened", "12,000 cm³ closed, 500 cm³ opened"],
    ["moved by 0.01 m; it shakes by 0.3 m/s", "moved by 10 mm; it shakes by 0.3 m/s"],
    ["2 kg on hulls of 1.5 l are 1.33e+03 kg/m³", "2 kg on hulls of 1,500 cm³ are 1.33e+03 kg/m³"],
    ["box2.5 meshes, 3 more, 7 labels", "box2.5 meshes, 3 more, 7 labels"],
  ])("has millimetres where these were chosen: %s", (text, wanted) => {
    expect(textIn(text, "mm")).toBe(wanted);
  });
});
