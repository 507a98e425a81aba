// A rule or an extractor in the language, coloured as it is read; labels carry their own colour below them.
import { memo, useEffect, useRef } from "react";
import { api } from "../../server/api";
import { useProject } from "../../store/project";
import { setHighlight } from "../../store/workspace";
import { tokenize } from "../../text/tokens";
import css from "./learn.module.css";

export const RuleText = memo(function RuleText({ text }: { text: string }) {
  const vocabulary = useProject((state) => state.project.vocabulary);
  const colors = new Map(vocabulary.map((label) => [label.name, label.color]));
  return (
    <code className={css.code}>
      {tokenize(text).map(({ kind, text: word, label }, k) => (
        <span key={k} data-kind={kind} style={{ borderColor: label === null ? undefined : colors.get(label) }}>
          {word}
        </span>
      ))}
    </code>
  );
});

/** Lights up what an extractor selects everywhere, asked for when one points at it. */
export function useExtractorHighlight(extractor: string, rule: number): { on: () => void; off: () => void } {
  const stop = useRef<AbortController | null>(null);
  useEffect(
    () => () => {
      // what one points at may be gone before the pointer leaves it
      if (stop.current && !stop.current.signal.aborted) setHighlight(null);
      stop.current?.abort();
    },
    [],
  );
  const off = () => {
    stop.current?.abort();
    setHighlight(null);
  };
  const on = () => {
    stop.current?.abort();
    const mine = new AbortController();
    stop.current = mine;
    api.generalise(extractor, rule, mine.signal).then(
      ({ assets }) => mine.signal.aborted || setHighlight({ what: extractor, assets }),
      () => undefined, // pointing at it reports no error; using it does
    );
  };
  return { on, off };
}
