// Keeps what is shown in step with what is chosen and with what the server says.
import { type DeskState, openAsset, show, type Showing, useDesk } from "./desk";
import { useProject } from "./project";
import { details, prefetch, showScene } from "./scenes";

/** Follows until the returned function is called. */
export function follow(): () => void {
  const stops = [
    useDesk.subscribe((now, before) => {
      if (now.asset !== before.asset || now.stage !== before.stage) void settle(now);
      else if (now.showing !== before.showing) void showScene(now.asset, now.showing);
    }),
    useProject.subscribe((now, before) => {
      const { asset, showing } = useDesk.getState();
      if (asset !== null && !(asset in now.cards)) return openAsset(now.order[0] ?? null);
      if (asset === null) return now.order.length ? openAsset(now.project.next.asset ?? now.order[0] ?? null) : undefined;
      const other = (key: "revisions" | "shapeRevisions") => now[key][asset] !== before[key][asset];
      const program = showing.kind === "result" && now.program.version !== before.program.version;
      if (other("revisions") || other("shapeRevisions")) void settle(useDesk.getState());
      else if (program) void showScene(asset, showing);
    }),
  ];
  return () => stops.forEach((stop) => stop());
}

/** Shows an asset in the state that its stage is about, and fetches those beside it. */
async function settle({ asset, stage }: DeskState): Promise<void> {
  if (asset === null) return void showScene(null, { kind: "source" });
  const usually = await usual(asset, stage).catch((): Showing => ({ kind: "source" }));
  const now = useDesk.getState();
  if (now.asset !== asset || now.stage !== stage) return;
  const showing = now.asked ?? usually;
  if (same(now.showing, showing)) void showScene(asset, showing);
  else show(showing);
  const { order } = useProject.getState();
  const at = order.indexOf(asset);
  for (const next of [order[at + 1], order[at - 1]]) if (next !== undefined) prefetch(next);
}

/** What a stage shows of an asset: its hulls, what its steps made of them so far, or the edited asset. */
async function usual(asset: string, stage: DeskState["stage"]): Promise<Showing> {
  if (stage === "label") return { kind: "source" };
  if (stage === "demonstrate") {
    const { view } = await details(asset);
    const broken = view.steps.findIndex((step) => step.error !== null);
    return { kind: "steps", steps: broken < 0 ? view.steps.length : broken };
  }
  const { cards, program, reach } = useProject.getState();
  const { output, stale } = cards[asset] ?? { output: "none", stale: [] };
  if (stage === "review" && (output === "edited" || output === "unchanged")) return { kind: "result", of: "output" };
  const fails = reach[asset] ? reach[asset].error !== null : output === "failed" && !stale.length;
  return program.text && !fails ? { kind: "result", of: "program" } : { kind: "source" };
}

function same(a: Showing, b: Showing): boolean {
  if (a.kind === "steps" && b.kind === "steps") return a.steps === b.steps;
  if (a.kind === "result" && b.kind === "result") return a.of === b.of;
  return a.kind === "source" && b.kind === "source";
}
