// The window: a bar, the family, the view with its steps, the panel of the stage; without assets, what to do.
import { FolderPlus } from "lucide-react";
import { Tooltip } from "radix-ui";
import { AddMenu, DropZone } from "../family/AddAssets";
import { Family } from "../family/Family";
import { StepStrip } from "../steps/StepStrip";
import { StartPage } from "../start/StartPage";
import { useProject } from "../store/project";
import { useStart } from "../store/start";
import { setLayout, useLayout, useWorkspace } from "../store/workspace";
import { Viewport } from "../viewport/Viewport";
import css from "./App.module.css";
import { Divider } from "../ui/Divider";
import { Help } from "./Help";
import empty from "./nothing.module.css";
import { Palette } from "./Palette";
import { WIDTHS } from "./preferences";
import { StageColumn } from "./StageColumn";
import { Toasts } from "./Toasts";
import { TopBar } from "./TopBar";
import { Tour } from "./Tour";
import { ConnectionBar, Welcome } from "./ConnectionState";

export function App() {
  const ready = useProject((state) => state.ready);
  const start = useStart((state) => state.view !== null);
  return (
    <Tooltip.Provider delayDuration={400} skipDelayDuration={150}>
      {ready ? <Window /> : <Before start={start} />}
    </Tooltip.Provider>
  );
}

/** The window before a project is there; messages lie over its foot. */
function Before({ start }: { start: boolean }) {
  return (
    <>
      {start ? <StartPage /> : <Welcome />}
      <div className={css.before}>
        <Toasts />
      </div>
    </>
  );
}

function Window() {
  return (
    <div className={css.window}>
      <TopBar />
      <ConnectionBar />
      <Columns />
      <Help />
      <Palette />
      <Tour />
      <DropZone />
    </div>
  );
}

function Columns() {
  const { family, panel } = useWorkspace((workspace) => workspace.columns);
  const open = useLayout((layout) => layout.family && !layout.gallery);
  // a column takes less than half of the window, see the style
  const widen = (which: "family" | "panel") => (width: number) =>
    useWorkspace.setState(({ columns }) => ({ columns: { ...columns, [which]: Math.min(width, 0.45 * window.innerWidth) } }));
  return (
    <div className={css.columns}>
      {open && (
        <aside className={css.family} style={{ width: family }} aria-label="Family" data-part data-tour="family">
          <Family />
          <Divider
            name="Width of the family"
            along="x"
            edge="right"
            value={family}
            range={WIDTHS.family}
            onChange={widen("family")}
            onCollapse={() => setLayout({ family: false })}
          />
        </aside>
      )}
      <Centre />
      <aside className={css.panel} style={{ width: panel }} aria-label="Stage" data-part data-tour="panel">
        <Divider name="Width of the panel" along="x" edge="left" flipped value={panel} range={WIDTHS.panel} onChange={widen("panel")} />
        <StageColumn />
        <Toasts />
      </aside>
    </div>
  );
}

/** The middle of the window: the view of one asset with its steps below, or the whole family. */
function Centre() {
  const gallery = useLayout((layout) => layout.gallery);
  const none = useProject(({ cards }) => Object.values(cards).every((card) => card.error !== null));
  if (none) return <EmptyProject />;
  return (
    <main className={css.centre}>
      <div className={css.view} data-part data-tour="view">
        {gallery ? <Family large /> : <Viewport />}
      </div>
      {!gallery && (
        <div className={css.steps} data-part data-tour="steps">
          <StepStrip />
        </div>
      )}
    </main>
  );
}

/** The window of a project without assets: what to do. */
function EmptyProject() {
  const broken = useProject((state) => state.order.length);
  const folder = useProject((state) => state.project.folder);
  const reading = useProject((state) => state.jobs.some((job) => job.kind === "read" && job.state === "running"));
  if (reading) {
    return (
      <main className={empty.nothing}>
        <p role="status">Reading the assets…</p>
      </main>
    );
  }
  return (
    <main className={empty.nothing} data-part>
      <FolderPlus size={40} strokeWidth={1.2} aria-hidden />
      <h2>{broken ? "No asset can be read" : "No assets yet"}</h2>
      {broken > 0 && <p>Each card on the left says what is wrong with its file and how to fix it.</p>}
      <p>
        Drop files or a folder onto this window: URDF, MJCF, SDF, GLB, OBJ, STL, PLY or VRML, with all files that they refer to.
        They are copied into the project.
      </p>
      <AddMenu words="Add assets" />
      <p className={empty.small}>
        Project folder: <code>{folder}</code>
      </p>
    </main>
  );
}
