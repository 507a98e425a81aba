// Gives the parts of the viewport the stage they belong to.
import { createContext, useContext, useEffect, useEffectEvent } from "react";
import type { Stage } from "./stage";

export const StageContext = createContext<Stage | null>(null);

export function useStage(): Stage {
  const stage = useContext(StageContext);
  if (!stage) throw new Error("this is a part of the viewport");
  return stage;
}

/** Calls back after each frame, with no rendering by React. */
export function useFrame(drawn: () => void): void {
  const stage = useStage();
  const call = useEffectEvent(drawn);
  useEffect(() => {
    stage.invalidate();
    return stage.onDrawn(() => call());
  }, [stage]);
}
