// What the server says of something that changes.
import { useEffect, useEffectEvent, useState } from "react";

/** Asks anew a moment after `of` has changed [ms]; the answer before stays until the next is there. */
export function useAnswer<T>(of: unknown, ask: (stop: AbortSignal) => Promise<T>, wait = 0): T | null {
  const [answer, setAnswer] = useState<T | null>(null);
  const askNow = useEffectEvent(ask);
  useEffect(() => {
    const stop = new AbortController();
    const take = (found: T) => stop.signal.aborted || setAnswer(found);
    const fail = (error: unknown) => {
      if (!stop.signal.aborted) throw error;
    };
    const timer = setTimeout(() => void askNow(stop.signal).then(take, fail), wait);
    return () => {
      clearTimeout(timer);
      stop.abort();
    };
  }, [of, wait]);
  return answer;
}
