// Measured figures as engineers read them: three digits, in the units in which findings are told.
import type { Figure } from "../wire";

type Unit = Figure["unit"];
const NOTHING = 1e-6; // of a unit: rounding, or less than anyone measures

/** `0.00927 m`, `0.558 l`, `12%`, `3`; null: `–`. One unit throughout, so that figures and findings can be compared. */
export function figureText(value: number | null, unit: Unit): string {
  if (value === null) return "–";
  return withUnit(Math.abs(value) < NOTHING ? "0" : threeDigits(value), unit);
}

const withUnit = (number: string, unit: string): string => (unit === "" || unit === "%" || unit === "°" ? number + unit : `${number} ${unit}`);

const threeDigits = (value: number): string => value.toLocaleString("en-GB", { maximumSignificantDigits: 3 });

/** Three digits that matter, no more. */
function shorten(value: number): string {
  return String(Number(value.toPrecision(3)));
}

/** A length with the unit that suits it. */
export function lengthText(meters: number): string {
  const size = Math.abs(meters);
  if (size >= 1) return `${shorten(meters)} m`;
  return size >= 0.01 ? `${shorten(100 * meters)} cm` : `${shorten(1000 * meters)} mm`;
}

/** A volume with the unit that suits it. */
export function volumeText(cubicMeters: number): string {
  if (cubicMeters >= 1) return `${shorten(cubicMeters)} m³`;
  if (cubicMeters >= 1e-3) return `${shorten(1e3 * cubicMeters)} l`;
  return cubicMeters >= 1e-6 ? `${shorten(1e6 * cubicMeters)} cm³` : `${shorten(1e9 * cubicMeters)} mm³`;
}
