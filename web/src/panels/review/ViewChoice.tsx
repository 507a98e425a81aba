// Which state of the asset the viewport shows, and how it is set beside the asset as it comes.
import { setView, useDesk, visit, type Compare } from "../../store/desk";
import { useProject } from "../../store/project";
import { Choice } from "../../ui/Choice";
import { Section } from "../../ui/Section";
import css from "./review.module.css";
import type { Of } from "./useResult";

const COMPARES: readonly { value: Compare; label: string; name: string }[] = [
  { value: "off", label: "Off", name: "No comparison" },
  { value: "slider", label: "Slider", name: "Before and after with a slider" },
  { value: "side", label: "Side by side", name: "Before and after side by side" },
];

export function ViewChoice({ asset, of }: { asset: string; of: Of }) {
  const compare = useDesk((state) => state.view.compare);
  const source = useDesk((state) => state.showing.kind !== "result");
  const written = useProject((state) => ["edited", "unchanged"].includes(state.cards[asset]?.output ?? "none"));
  const states = [
    { value: "source", label: "As it comes" },
    ...(written ? [{ value: "output", label: "Written", name: "The output as it was written" }] : []),
    { value: "program", label: "Now", name: "What the program makes of it now" },
  ];
  const shown = source ? "source" : of;
  return (
    <Section title="In the view">
      <div className={css.choices}>
        <span>State</span>
        <Choice
          name="State of the asset"
          value={shown}
          options={states}
          onChange={(value) => visit(asset, value === "source" ? { kind: "source" } : { kind: "result", of: value as Of })}
        />
        <span>Compare</span>
        <Choice name="Compare with the asset as it comes" value={compare} options={COMPARES} onChange={(value) => setView({ compare: value })} />
      </div>
    </Section>
  );
}
