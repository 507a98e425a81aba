// Which state of the asset is shown: as it comes, after some of its steps, or what the program makes of it.
import { Check, ChevronDown } from "lucide-react";
import { type Showing, useDesk, visit } from "../../store/desk";
import { useAssetView } from "../../store/hooks";
import { useProject } from "../../store/project";
import { Button } from "../../ui/Button";
import { Menu } from "../../ui/Menu";
import css from "./toolbar.module.css";

export function ShowingMenu() {
  const asset = useDesk((desk) => desk.asset);
  const showing = useDesk((desk) => desk.showing);
  const steps = useAssetView()?.steps ?? [];
  const program = useProject((state) => state.program.text !== "");
  const written = useProject(({ cards }) => ["edited", "unchanged"].includes(cards[asset ?? ""]?.output ?? "none"));
  const states: Showing[] = [
    { kind: "source" },
    ...steps.map((_, k): Showing => ({ kind: "steps", steps: k + 1 })),
    ...(program ? [{ kind: "result", of: "program" } as const] : []),
    ...(written ? [{ kind: "result", of: "output" } as const] : []),
  ];
  const now = nameOf(showing);
  if (asset === null || states.length < 2) return <span className={css.state}>{now}</span>;
  return (
    <Menu
      trigger={
        <Button look="quiet" className={css.state} aria-label={`Shown: ${now}`} data-testid="showing">
          {now}
          <ChevronDown size={13} aria-hidden />
        </Button>
      }
      lines={states.map((state) => ({
        label: (
          <span className={css.labelLine}>
            <Check size={13} aria-hidden style={{ visibility: nameOf(state) === now ? "visible" : "hidden" }} />
            {nameOf(state)}
            {state.kind === "steps" && <small>{steps[state.steps - 1]?.action}</small>}
          </span>
        ),
        onSelect: () => visit(asset, state),
      }))}
    />
  );
}

function nameOf(showing: Showing): string {
  if (showing.kind === "source" || (showing.kind === "steps" && showing.steps === 0)) return "As it comes";
  if (showing.kind === "steps") return `After step ${showing.steps}`;
  return showing.of === "program" ? "By the program" : "Written output";
}
