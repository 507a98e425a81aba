import { expect, it } from "vitest";
import { figureText } from "./units";

it("has three digits, in the unit in which findings are told, however small", () => {
  expect(figureText(0.0397, "m")).toBe("0.0397 m");
  expect(figureText(1.23456, "m")).toBe("1.23 m");
  expect(figureText(0.558, "l")).toBe("0.558 l");
  expect(figureText(0.00119, "l")).toBe("0.00119 l");
  expect(figureText(12345, "l")).toBe("12,300 l");
  expect(figureText(0.0424, "kg")).toBe("0.0424 kg");
  expect(figureText(33.333, "%")).toBe("33.3%");
  expect(figureText(180, "°")).toBe("180°");
  expect(figureText(3, "")).toBe("3");
});

it("says nothing of rounding, and of what is not known", () => {
  expect(figureText(2.3e-11, "m/s")).toBe("0 m/s");
  expect(figureText(0, "l")).toBe("0 l");
  expect(figureText(null, "m")).toBe("–");
});
