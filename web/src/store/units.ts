// Measured figures as engineers read them: three digits, in a unit that leaves few zeros.
import type { Figure } from "../wire";

type Unit = Figure["unit"];
/** A smaller unit, how many of them one is, and from where on the unit itself is used. */
const SMALLER: Partial<Record<Unit, readonly [string, number]>> = {
  m: ["mm", 1000],
  "m/s": ["mm/s", 1000],
  l: ["ml", 1000],
  kg: ["g", 1000],
};
const NOTHING = 1e-6; // of a unit: rounding, or less than anyone measures

/** `9.27 mm`, `0.558 l`, `12%`, `3`; null: `–`. */
export function figureText(value: number | null, unit: Unit): string {
  if (value === null) return "–";
  const size = Math.abs(value);
  const small = SMALLER[unit];
  if (size < NOTHING) return joined("0", unit);
  return small && size < 0.1 ? joined(digits(value * small[1]), small[0]) : joined(digits(value), unit);
}

const joined = (number: string, unit: string): string => (unit === "" || unit === "%" || unit === "°" ? number + unit : `${number} ${unit}`);

const digits = (value: number): string => value.toLocaleString("en-GB", { maximumSignificantDigits: 3 });
