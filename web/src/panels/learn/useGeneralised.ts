// Lights up what an extractor selects everywhere, asked for when one points at it.
import { useEffect, useRef } from "react";
import { api } from "../../server/api";
import { setHighlight } from "../../store/desk";

export function useGeneralised(extractor: string, rule: number): { on: () => void; off: () => void } {
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
      () => undefined, // pointing at it is no request to be told about; using it is
    );
  };
  return { on, off };
}
