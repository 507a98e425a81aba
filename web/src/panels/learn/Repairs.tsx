// Labels that are probably wrong, each as a card to accept or reject.
import { Section } from "../../ui/Section";
import { counted } from "../../store/words";
import type { RepairView } from "../../wire";
import { RepairCard } from "./RepairCard";

export function Repairs({ repairs }: { repairs: readonly RepairView[] }) {
  return (
    <Section title="Labels that may be wrong" aside={counted(repairs.length, "label")}>
      {repairs.map((repair) => (
        <RepairCard key={repair.id} repair={repair} />
      ))}
    </Section>
  );
}
