// The menus of the toolbar: what is done to the selection, which state is shown, by what hulls are coloured, and from
// where one looks.
import { Box, ChevronDown, Cuboid, Maximize, Palette, Video } from "lucide-react";
import { useProject } from "../../store/project";
import { type Scene, useAssetView, useScenes } from "../../store/scenes";
import { type ColorBy, select, setUnit, setView, type Showing, useUnit, useWorkspace, visit } from "../../store/workspace";
import { Button, IconButton } from "../../ui/Button";
import { choiceLines, Menu, type MenuLine } from "../../ui/Menu";
import { Swatch } from "../../ui/Section";
import { linesOf, runs } from "./commandLines";
import css from "./toolbar.module.css";

export function SelectionMenu() {
  const count = useWorkspace((workspace) => workspace.selection.size);
  const scene = useScenes((state) => state.scene);
  // what is hidden and selected decides which lines make sense
  useWorkspace((workspace) => workspace.hidden);
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
        "line",
        ...linesOf(["select-similar", "select-similar-everywhere"]),
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
      <>
        <Swatch color={color} /> All {name ?? "without a label"} <small>{names.length}</small>
      </>
    );
    return [{ label, onSelect: () => select(names) }];
  });
}

/** Which state of the asset is shown: original, after some of its steps, or what the program makes of it. */
export function ShowingMenu() {
  const asset = useWorkspace((workspace) => workspace.asset);
  const showing = useWorkspace((workspace) => workspace.showing);
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
          <>
            {nameOf(state)}
            {state.kind === "steps" && <small>{steps[state.steps - 1]?.action.text}</small>}
          </>
        ),
        on: nameOf(state) === now,
        onSelect: () => visit(asset, state),
      }))}
    />
  );
}

function nameOf(showing: Showing): string {
  if (showing.kind === "source" || (showing.kind === "steps" && showing.steps === 0)) return "Original";
  if (showing.kind === "hulls") return "Hulls to try";
  if (showing.kind === "steps") return `After step ${showing.steps}`;
  return showing.of === "program" ? "By the program" : "Written output";
}

const NAMES: Readonly<Record<ColorBy, string>> = { label: "Label", hull: "Hull", body: "Body" };

/** By what hulls are coloured. */
export function ColorChoice() {
  const colorBy = useWorkspace((workspace) => workspace.view.colorBy);
  return (
    <Menu
      trigger={
        <Button look="quiet" icon={Palette} className={css.small} aria-label={`Colour by ${NAMES[colorBy]}`}>
          {NAMES[colorBy]}
          <ChevronDown size={13} aria-hidden />
        </Button>
      }
      lines={choiceLines(NAMES, colorBy, (value) => setView({ colorBy: value }))}
    />
  );
}

const UNITS = { m: "Lengths in metres", mm: "Lengths in millimetres" } as const;

/** The camera: projection, fitting, standard views; the grid, and the unit of lengths. */
export function ViewMenu() {
  const isSheet = useWorkspace((workspace) => workspace.sheet.length > 0);
  const parallel = useWorkspace((workspace) => workspace.view.projection === "orthographic") || isSheet;
  const projection = parallel ? "Parallel projection; switch to perspective" : "Perspective; switch to parallel projection";
  const grid = useWorkspace((workspace) => workspace.view.grid);
  const unit = useUnit();
  // whether something is shown decides which lines make sense
  useScenes(({ scene }) => scene === null);
  return (
    <div className={css.group} role="group" aria-label="Camera">
      <IconButton
        icon={parallel ? Box : Cuboid}
        name={isSheet ? "Parallel projection, in which sizes compare" : projection}
        disabled={isSheet}
        {...runs("projection")}
      />
      <IconButton icon={Maximize} name="Fit all into the view" {...runs("fit")} />
      <Menu
        trigger={
          <button type="button" className={css.camera} aria-label="Standard views, grid and units" title="Standard views, grid and units">
            <Video size={16} aria-hidden />
          </button>
        }
        lines={[
          ...linesOf(["view-front", "view-back", "view-right", "view-left", "view-top", "view-bottom", "view-iso"]),
          "line",
          ...linesOf(["fit", "frame"]),
          "line",
          { label: "Grid and axes", on: grid, onSelect: () => setView({ grid: !grid }) },
          "line",
          ...choiceLines(UNITS, unit, setUnit),
        ]}
      />
    </div>
  );
}
