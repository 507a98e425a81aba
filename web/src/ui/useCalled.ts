// A place that takes the focus when it is called for.
import { useEffect } from "react";
import { type Place, takeCall, useCalls } from "../store/calls";

/** Does something, such as taking the focus, when a place is called for. */
export function useCalled(place: Place, does: () => void): void {
  const calls = useCalls((state) => state.count);
  useEffect(() => {
    if (takeCall(place)) does();
    // eslint-disable-next-line react-hooks/exhaustive-deps -- once a call
  }, [calls, place]);
}
