// Measured figures as engineers read them: three digits, lengths and volumes in the one unit that the person chose.
import type { Figure } from "../wire";

/** Lengths in metres go with litres, those in millimetres with cubic centimetres. */
export type LengthUnit = "m" | "mm";

const LENGTHS: Readonly<Record<LengthUnit, number>> = { m: 1, mm: 1000 };
const VOLUMES: Readonly<Record<LengthUnit, { name: string; ofCubicMeter: number }>> = {
  m: { name: "l", ofCubicMeter: 1e3 },
  mm: { name: "cm³", ofCubicMeter: 1e6 },
};
const NOTHING = 1e-6; // of a unit: rounding, or less than anyone measures

/** A length [m]: `0.00927 m` or `9.27 mm`. */
export function lengthText(meters: number, unit: LengthUnit, digits = 3): string {
  return `${numberText(LENGTHS[unit] * meters, digits)} ${unit}`;
}

/** Lengths [m] without their unit, as fine as four digits of the largest are. */
export function lengthNumbers(meters: readonly number[], unit: LengthUnit): string[] {
  const values = meters.map((value) => LENGTHS[unit] * value);
  const largest = Math.max(...values.map(Math.abs), 1e-9);
  const decimals = Math.min(9, Math.max(0, 3 - Math.floor(Math.log10(largest))));
  return values.map((value) => value.toLocaleString("en-GB", { maximumFractionDigits: decimals }));
}

/** A volume [m³]: `0.558 l` or `558 cm³`. */
export function volumeText(cubicMeters: number, unit: LengthUnit): string {
  const { name, ofCubicMeter } = VOLUMES[unit];
  return `${numberText(ofCubicMeter * cubicMeters)} ${name}`;
}

/** A figure of a check: `0.00927 m`, `0.558 l`, `12%`, `3`; null: `–`. */
export function figureText(value: number | null, of: Figure["unit"], unit: LengthUnit): string {
  if (value === null) return "–";
  if (of === "m") return lengthText(value, unit);
  if (of === "l") return volumeText(value / 1e3, unit);
  const number = numberText(value);
  return of === "" || of === "%" || of === "°" ? number + of : `${number} ${of}`;
}

function numberText(value: number, digits = 3): string {
  return Math.abs(value) < NOTHING ? "0" : value.toLocaleString("en-GB", { maximumSignificantDigits: digits });
}

const NUMBER = String.raw`-?\d+(?:\.\d+)?(?:e[+-]?\d+)?`;
/** Numbers with their unit as messages have them: `0.01 m`, `0.1 × 0.2 × 0.3 m`, `1, 2, 3 (0.1 × 0.2 × 0.3 m`. */
const SIZES = new RegExp(String.raw`(?<![\w.])((?:${NUMBER}, ${NUMBER}, ${NUMBER} \()?${NUMBER}(?: × ${NUMBER})*) (m|l)(?![\w²³/·])`, "g");

/** A message of the server, which has lengths in metres and volumes in litres, in the chosen unit. */
export function textIn(text: string, unit: LengthUnit): string {
  if (unit === "m") return text;
  return text.replace(SIZES, (_, numbers: string, of: "m" | "l") => {
    const { name, ofCubicMeter } = VOLUMES[unit];
    const [times, to] = of === "m" ? [LENGTHS[unit], unit] : [ofCubicMeter / 1e3, name];
    return `${numbers.replaceAll(new RegExp(NUMBER, "g"), (number) => numberText(times * Number(number)))} ${to}`;
  });
}
