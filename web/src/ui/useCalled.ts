// A place that takes the focus when it is called for.
import { useEffect, useEffectEvent } from "react";
import { type Place, takeCall, useCalls } from "../store/calls";

/** Does something, such as taking the focus, when a place is called for. */
export function useCalled(place: Place, does: () => void): void {
  const calls = useCalls((state) => state.count);
  const act = useEffectEvent(does);
  useEffect(() => {
    if (takeCall(place)) act();
  }, [calls, place]);
}
