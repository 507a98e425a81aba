// One of the six directions of the upright asset, axis by axis.
import css from "./demonstrate.module.css";

const AXES = [
  { axis: "X", words: ["+X", "-X"] },
  { axis: "Y", words: ["+Y", "-Y"] },
  { axis: "Z", words: ["+Z", "-Z"] },
] as const;
const MEANING: Readonly<Record<string, string>> = { "+Z": "top", "-Z": "bottom" };

export function DirectionField({ value, onChange }: { value: string; onChange: (value: string) => void }) {
  return (
    <div className={css.directions} role="radiogroup" aria-label="Direction">
      {AXES.map(({ axis, words }) => (
        <div key={axis} data-axis={axis}>
          {words.map((word) => (
            <label key={word} data-on={word === value || undefined}>
              <input
                type="radio"
                className="visually-hidden"
                name="direction"
                checked={word === value}
                onChange={() => onChange(word)}
              />
              {word.replace("-", "−")}
              {MEANING[word] && <small>{MEANING[word]}</small>}
            </label>
          ))}
        </div>
      ))}
    </div>
  );
}
