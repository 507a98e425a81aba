// The stage in which a person shows what to do: the action in hand, the family's rules, orientation, preparation.
import { useEffect } from "react";
import { followGuesses } from "../../store/guesses";
import { askLanguage } from "../../store/language";
import { followPreview } from "../../store/previewing";
import { Section } from "../../ui/Section";
import { DraftForm } from "./DraftForm";
import { Orientation } from "./Orientation";
import { Preparation } from "./Preparation";
import { Rules } from "./Rules";
import css from "./demonstrate.module.css";

export function DemonstratePanel() {
  useEffect(askLanguage, []);
  useEffect(() => followPreview(false), []);
  useEffect(followGuesses, []);
  return (
    <div className={css.panel} data-tour="demonstrate">
      <Section title="What to do with the selected hulls">
        <DraftForm />
      </Section>
      <Rules />
      <Orientation />
      <Preparation />
    </div>
  );
}
