// How hulls are made: the tool, how many a piece may have, and how close they are.
import { parseLimit, setOptions, useDecompose, useIsBegun } from "../store/decompose";
import { Choice } from "./fields";
import css from "./ui.module.css";

const METHODS = [
  { value: "coacd", label: "CoACD", about: "Follows the shape closely, with few hulls; seconds to minutes a piece." },
  { value: "vhacd", label: "V-HACD", about: "Quicker, and coarser." },
] as const;
const ALIKE = { value: "alike", label: "As the others", about: "As those of the assets that have them were made." } as const;

export function HullSettings() {
  const { method, most, threshold } = useDecompose((state) => state.options);
  const isBegun = useIsBegun();
  const ways = isBegun ? [ALIKE, ...METHODS] : METHODS;
  const way = method ?? (isBegun ? "alike" : "coacd");
  return (
    <div className={css.hullSettings}>
      <Choice name="What makes the hulls" value={way} options={ways} onChange={(to) => setOptions({ method: to === "alike" ? null : to })} />
      <span>{ways.find(({ value }) => value === way)?.about}</span>
      {way !== "alike" && <label>
        Hulls of a piece, at most
        <input type="number" min={1} max={4096} placeholder={way === "vhacd" ? "64" : "no limit"} value={most ?? ""} onChange={(event) => setOptions({ most: parseLimit(event.target.value, 1, 4096) })} />
      </label>}
      {way === "coacd" && (
        <details>
          <summary>More</summary>
          <label>
            Threshold: lower gives more, closer hulls
            <input type="number" min={0.01} max={1} step={0.01} placeholder="0.05" defaultValue={threshold ?? ""} onChange={(event) => setOptions({ threshold: parseLimit(event.target.value, 0.01, 1) })} />
          </label>
        </details>
      )}
    </div>
  );
}
