// What was said so far: answers and repairs, each of which can be taken back.
import { Check, CornerUpLeft, MessageCircleReply, X } from "lucide-react";
import { takeBack } from "../../commands/learning";
import { useProject } from "../../store/project";
import { counted } from "../../store/words";
import type { Said } from "../../wire";
import { IconButton } from "../../ui/Button";
import { Section } from "../../ui/Section";
import css from "./learn.module.css";

const ICONS = { answer: MessageCircleReply, confirmed: Check, rejected: X } as const;
const KINDS = { answer: "Answer", confirmed: "Repair accepted", rejected: "Repair rejected" } as const;

export function SaidList() {
  const said = useProject((state) => state.project.said);
  const stale = useProject((state) => state.lesson?.stale);
  if (!said.length) return null;
  return (
    <Section title="Said so far" aside={counted(said.length, "thing")}>
      <ul className={css.said}>
        {said.map((line) => (
          <SaidRow key={`${line.kind} ${line.id}`} line={line} stale={stale?.includes(line.id) ?? false} />
        ))}
      </ul>
    </Section>
  );
}

function SaidRow({ line, stale }: { line: Said; stale: boolean }) {
  const Icon = ICONS[line.kind];
  return (
    <li className={css.saidRow}>
      <Icon size={14} aria-label={KINDS[line.kind]} />
      <span title={line.asset}>
        {line.text}
        {stale && <em className={css.stale}> no longer fits what is there, and is left out</em>}
      </span>
      <IconButton icon={CornerUpLeft} name={`Take back: ${line.text}`} onClick={() => void takeBack(line.id)} />
    </li>
  );
}
