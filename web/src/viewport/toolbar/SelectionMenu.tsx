// How many hulls are selected, and what can be done to the selection.
import { ChevronDown } from "lucide-react";
import { select, useDesk } from "../../store/desk";
import { useProject } from "../../store/project";
import { type Scene, useScenes } from "../../store/scenes";
import { Button } from "../../ui/Button";
import { Menu, type MenuLine } from "../../ui/Menu";
import { Swatch } from "../../ui/Section";
import { linesOf } from "./keys";
import css from "./toolbar.module.css";

export function SelectionMenu() {
  const count = useDesk((desk) => desk.selection.size);
  const scene = useScenes((state) => state.scene);
  // what is hidden and selected decides which lines make sense
  useDesk((desk) => desk.hidden);
  const vocabulary = useProject(({ project }) => project.vocabulary);
  const labels = scene ? labelLines(scene, vocabulary) : [];
  return (
    <Menu
      trigger={
        <Button className={css.selection} data-testid="selection">
          {count} selected
          <ChevronDown size={13} aria-hidden />
        </Button>
      }
      lines={[
        ...linesOf(["select-all", "select-none", "select-invert"]),
        "line",
        ...linesOf(["select-grow", "select-connected", "select-alike"]),
        ...(labels.length ? ["line" as const, ...labels] : []),
        "line",
        ...linesOf(["hide", "isolate", "show-all"]),
      ]}
    />
  );
}

/** A line for each label that hulls in the scene have, and for those without one. */
function labelLines({ hulls }: Scene, vocabulary: readonly { name: string; color: string }[]): MenuLine[] {
  const all = [...vocabulary, { name: null, color: "var(--hull-unlabelled)" }];
  return all.flatMap(({ name, color }) => {
    const names = hulls.filter((hull) => hull.label === name).map((hull) => hull.name);
    if (!names.length || names.length === hulls.length) return [];
    const label = (
      <span className={css.labelLine}>
        <Swatch color={color} /> All {name ?? "without a label"} <small>{names.length}</small>
      </span>
    );
    return [{ label, onSelect: () => select(names) }];
  });
}
