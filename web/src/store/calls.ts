// Calls for a place on the page, such as the card of the question or the button that does the next step: it takes the focus
// once it is there.
import { useEffect, useEffectEvent } from "react";
import { create } from "zustand";

export type Place = "card" | "vocabulary" | "apply" | "export" | "add";

export const useCalls = create<{ count: number; place: Place | null }>()(() => ({ count: 0, place: null }));

export const callFor = (place: Place): void => useCalls.setState(({ count }) => ({ count: count + 1, place }));

/** Whether a place was called for since it was asked last; so one that a call brings onto the page knows of it, too. */
export function takeCall(place: Place): boolean {
  const isCalled = useCalls.getState().place === place;
  if (isCalled) useCalls.setState({ place: null });
  return isCalled;
}

/** Does something, such as taking the focus, when a place is called for. */
export function useCalled(place: Place, does: () => void): void {
  const calls = useCalls((state) => state.count);
  const act = useEffectEvent(does);
  useEffect(() => {
    if (takeCall(place)) act();
  }, [calls, place]);
}
