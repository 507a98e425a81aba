// A rule or an extractor in the language, coloured as it is read; labels carry their own colour below them.
import { memo } from "react";
import { useProject } from "../../store/project";
import { tokens } from "../../store/tokens";
import css from "./learn.module.css";

export const RuleText = memo(function RuleText({ text }: { text: string }) {
  const vocabulary = useProject((state) => state.project.vocabulary);
  const colors = new Map(vocabulary.map((label) => [label.name, label.color]));
  return (
    <code className={css.code}>
      {tokens(text).map(({ kind, text: word, label }, k) => (
        <span key={k} data-kind={kind} style={{ borderColor: label === null ? undefined : colors.get(label) }}>
          {word}
        </span>
      ))}
    </code>
  );
});
