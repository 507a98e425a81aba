// What an edited asset comes to: its header, fetched anew when the asset, the program or the output changes.
import { useEffect, useState } from "react";
import { ServerProblem } from "../../server/http";
import { useDesk } from "../../store/desk";
import { useProject } from "../../store/project";
import { type Scene, sceneOf } from "../../store/scenes";
import type { Problem } from "../../wire";

export type Of = "program" | "output";
export type Result = { kind: "coming" } | { kind: "there"; of: Of; scene: Scene } | { kind: "problem"; problem: Problem };

/** Which result of an asset is looked at: the one that is shown; else the written one, if there is one. */
export function useOf(asset: string): Of {
  const showing = useDesk((state) => state.showing);
  const written = useProject((state) => ["edited", "unchanged"].includes(state.cards[asset]?.output ?? "none"));
  if (showing.kind === "result") return showing.of === "output" && !written ? "program" : showing.of;
  return written ? "output" : "program";
}

export function useResult(asset: string, of: Of): Result {
  const state = useProject((now) =>
    [now.revisions[asset], now.shapeRevisions[asset], now.program.version, now.cards[asset]?.edited_picture].join(" "),
  );
  const empty = useProject((now) => of === "program" && !now.program.text.trim());
  const key = `${asset} ${of} ${state}`;
  const [got, setGot] = useState<{ asset: string; key: string; result: Result } | null>(null);
  useEffect(() => {
    if (empty) return;
    let wanted = true;
    const take = (result: Result) => wanted && setGot({ asset, key, result });
    sceneOf(asset, { kind: "result", of }).then(
      (scene) => take({ kind: "there", of, scene }),
      (error: unknown) => {
        if (error instanceof ServerProblem) take({ kind: "problem", problem: error.problem });
        else throw error;
      },
    );
    return () => {
      wanted = false;
    };
  }, [asset, of, key, empty]);
  // the result before stays while the next of the same asset comes, so that nothing flickers
  return got?.asset === asset && !empty ? got.result : { kind: "coming" };
}
