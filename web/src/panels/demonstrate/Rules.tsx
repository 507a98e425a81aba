// The family's rules as a list to tick off on the asset in hand, with a guess for those that are open.
import { useAssetView } from "../../store/hooks";
import { useGuesses } from "../../store/guesses";
import { useProject } from "../../store/project";
import { openPlaces } from "../../store/drafts";
import { Note, Section } from "../../ui/Section";
import css from "./demonstrate.module.css";
import { RuleRow } from "./RuleRow";

export function Rules() {
  const rules = useProject((state) => state.project.rules);
  const view = useAssetView();
  const loading = useGuesses((state) => state.loading);
  const error = useGuesses((state) => state.error);
  if (!view || !rules.length) return null;
  const open = openPlaces(rules, view);
  const said = rules.length - open.length;
  return (
    <Section title="Rules of the family" aside={loading ? "guessing…" : `${said} of ${rules.length} shown here`}>
      {error && open.length > 0 && <Note mood="warn">No guesses: {error}</Note>}
      <ol className={css.rules}>
        {rules.map((rule, place) => (
          <RuleRow
            key={rule.rule}
            rule={rule}
            place={place}
            view={view}
            rules={rules.length}
            isNext={place === open[0]}
          />
        ))}
      </ol>
      {!open.length && rules.length > 0 && (
        <p className={css.hint}>All rules are shown on this asset. Another one may show a case that differs.</p>
      )}
    </Section>
  );
}
