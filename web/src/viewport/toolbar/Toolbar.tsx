// The bar over the picture, one row: tools and selecting, then looking.
import {
  BoxSelect,
  Columns2,
  Expand,
  Ghost,
  Grid2x2X,
  Lasso,
  Layers2,
  MousePointer2,
  Network,
  Ruler,
  Slice,
  Square,
  SquareDashedBottom,
  SquareSplitHorizontal,
  Triangle,
} from "lucide-react";
import { lazy, Suspense } from "react";
import { startCut } from "../../commands/demonstrate";
import { useScenes, waitForFirstScene } from "../../store/scenes";
import { useSection } from "../../store/section";
import { type Compare, setTool, setView, useWorkspace } from "../../store/workspace";
import { IconButton, Tip } from "../../ui/Button";
import { Choice, Slide } from "../../ui/fields";
import { runs } from "./commandLines";
import { FittedRow, type Part } from "./FittedRow";
import { ColorChoice, SelectionMenu, ShowingMenu, ViewMenu } from "./menus";
import css from "./toolbar.module.css";

/** Its editor takes longer to begin than the picture, so it comes after it. */
const ExtractorField = lazy(async () => {
  await waitForFirstScene();
  return { default: (await import("../../text/ExtractorField")).ExtractorField };
});

/** The parts of the bar from left to right; keep: those with the highest stay longest where there is not room for all. */
const PARTS: readonly Part[] = [
  { id: "tools", name: "Tools", keep: 9, node: <Tools /> },
  { id: "selection", name: "Selection", keep: 8, node: <SelectionMenu /> },
  {
    id: "rule",
    name: "Select by a rule",
    keep: 6,
    grows: true,
    node: (
      <Suspense fallback={<div className={css.field} />}>
        <ExtractorField />
      </Suspense>
    ),
  },
  { id: "showing", name: "State", keep: 7, node: <ShowingMenu /> },
  { id: "compare", name: "Before and after", keep: 5, node: <CompareChoice /> },
  { id: "color", name: "Colour", keep: 4, node: <ColorChoice /> },
  { id: "switches", name: "Overlays", keep: 2, node: <Switches /> },
  { id: "explode", name: "Exploded view", keep: 1, node: <ExplodeSlide /> },
  { id: "camera", name: "Camera", keep: 3, node: <ViewMenu /> },
];

export function Toolbar() {
  const there = useScenes(({ scene }) => scene !== null);
  return (
    <div className={css.bar} role="toolbar" aria-label="View" inert={!there}>
      <FittedRow parts={PARTS} />
    </div>
  );
}

const TAKES = "selects hulls that are visible inside or completely inside; Shift adds, Alt subtracts";

/** What the left button does, and the section plane. */
function Tools() {
  const tool = useWorkspace((workspace) => workspace.tool);
  const through = useWorkspace((workspace) => workspace.through);
  const isCutOpen = useSection((section) => section.on);
  return (
    <div className={css.group} role="group" aria-label="Tools">
      <IconButton
        icon={MousePointer2}
        name="Select by clicking; Shift adds, Ctrl toggles; drag to orbit"
        on={tool === "select"}
        onClick={() => setTool("select")}
      />
      <IconButton icon={BoxSelect} name={`Box: ${TAKES}`} on={tool === "box"} {...runs("tool-box")} />
      <IconButton icon={Lasso} name={`Lasso: ${TAKES}`} on={tool === "lasso"} {...runs("tool-lasso")} />
      <IconButton
        icon={Layers2}
        name="Select through: box, lasso and repeated clicks also take hulls behind others; Alt+click takes the next one behind"
        on={through}
        {...runs("select-through")}
      />
      <IconButton
        icon={Slice}
        name="Cut a hull in two by a plane"
        keys="K"
        on={tool === "cut"}
        onClick={() => (tool === "cut" ? setTool("select") : startCut())}
      />
      <IconButton icon={Ruler} name="Ruler: measure between two points, or the selection" on={tool === "ruler"} {...runs("tool-ruler")} />
      <IconButton icon={SquareDashedBottom} name="Section plane: see inside" on={isCutOpen} {...runs("section")} />
    </div>
  );
}

/** What is drawn besides the hulls, and how. */
function Switches() {
  const ghosts = useScenes(({ scene }) => scene?.view.has_visual ?? false);
  const opaque = useScenes(({ scene }) => scene?.view.non_convex.length ?? 0);
  return (
    <div className={css.group} role="group" aria-label="Overlays">
      <Switch what="contacts" icon={Network} name="Contact graph; near misses are dashed" />
      <Switch what="wireframe" icon={Triangle} name="Wireframe" />
      {ghosts && <Switch what="ghost" icon={Ghost} name="Visual mesh as a ghost" />}
      {opaque > 0 && <Switch what="opaque" icon={Grid2x2X} name={`Non-convex pieces (${opaque})`} />}
    </div>
  );
}

type What = "contacts" | "wireframe" | "ghost" | "opaque";

function Switch({ what, icon, name }: { what: What; icon: typeof Ghost; name: string }) {
  const on = useWorkspace((workspace) => workspace.view[what]);
  return <IconButton icon={icon} name={name} on={on} {...runs(`toggle-${what}`)} />;
}

const OPTIONS: readonly { value: Compare; icon: typeof Square; name: string }[] = [
  { value: "off", icon: Square, name: "No comparison" },
  { value: "slider", icon: SquareSplitHorizontal, name: "Before and after with a line between them" },
  { value: "side", icon: Columns2, name: "Before and after side by side" },
];

/** Before and after: off, with a line between them, or side by side. */
function CompareChoice() {
  const compare = useWorkspace((workspace) => workspace.view.compare);
  const edited = useScenes(({ scene }) => scene?.edit != null);
  if (!edited) return null;
  return (
    <Choice
      name="Compare with the original asset"
      value={compare}
      options={OPTIONS.map(({ value, icon: Icon, name }) => ({ value, name, label: <Icon size={15} aria-hidden /> }))}
      onChange={(value) => setView({ compare: value })}
    />
  );
}

/** How far hulls are moved apart; a double click puts them together again. */
function ExplodeSlide() {
  const explode = useWorkspace((workspace) => workspace.view.explode);
  return (
    <Tip text="Exploded view; double-click to reset">
      <span className={css.explode} onDoubleClick={() => setView({ explode: 0 })}>
        <Expand size={15} aria-hidden />
        <Slide name="Exploded view" value={explode} onChange={(value) => setView({ explode: value })} />
      </span>
    </Tip>
  );
}
