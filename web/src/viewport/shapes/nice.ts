// Round lengths, and how lengths and volumes are written.
/** The largest of 1, 2 and 5 times a power of ten that is not above a length. */
export function niceStep(length: number): number {
  const power = 10 ** Math.floor(Math.log10(length));
  const times = length / power;
  return (times >= 5 ? 5 : times >= 2 ? 2 : 1) * power;
}

/** A length with the unit that suits it. */
export function lengthText(meters: number): string {
  const size = Math.abs(meters);
  if (size >= 1) return `${short(meters)} m`;
  return size >= 0.01 ? `${short(100 * meters)} cm` : `${short(1000 * meters)} mm`;
}

/** A volume with the unit that suits it. */
export function volumeText(cubicMeters: number): string {
  if (cubicMeters >= 1) return `${short(cubicMeters)} m³`;
  if (cubicMeters >= 1e-3) return `${short(1e3 * cubicMeters)} l`;
  return cubicMeters >= 1e-6 ? `${short(1e6 * cubicMeters)} cm³` : `${short(1e9 * cubicMeters)} mm³`;
}

/** Three digits that matter, no more. */
function short(value: number): string {
  return String(Number(value.toPrecision(3)));
}
