// The window: a bar, the family, the view with its steps, the panel of the stage.
import { Tooltip } from "radix-ui";
import { Adding } from "../family/Adding";
import { Family } from "../family/Family";
import { useDesk } from "../store/desk";
import { WIDTHS } from "../store/kept";
import { setLayout, useLayout } from "../store/layout";
import { useProject } from "../store/project";
import { Tour } from "../tour/Tour";
import css from "./App.module.css";
import { Centre } from "./Centre";
import { ConnectionBar, Welcome } from "./Unconnected";
import { Divider } from "./Divider";
import { Help } from "./Help";
import { Palette } from "./Palette";
import { Side } from "./Side";
import { Toasts } from "./Toasts";
import { TopBar } from "./TopBar";

export function App() {
  const ready = useProject((state) => state.ready);
  return (
    <Tooltip.Provider delayDuration={400} skipDelayDuration={150}>
      {ready ? <Window /> : <Welcome />}
      <Toasts />
    </Tooltip.Provider>
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
      <Adding />
    </div>
  );
}

function Columns() {
  const { family, panel } = useDesk((desk) => desk.columns);
  const open = useLayout((layout) => layout.family && !layout.gallery);
  const widen = (change: Partial<{ family: number; panel: number }>) =>
    useDesk.setState(({ columns }) => ({ columns: { ...columns, ...change } }));
  return (
    <div className={css.columns}>
      {open && (
        <>
          <aside className={css.family} style={{ width: family }} aria-label="Family" data-part data-tour="family">
            <Family />
          </aside>
          <Divider
            name="Width of the family"
            along="x"
            value={family}
            range={WIDTHS.family}
            onChange={(width) => widen({ family: width })}
            onCollapse={() => setLayout({ family: false })}
          />
        </>
      )}
      <Centre />
      <Divider
        name="Width of the panel"
        along="x"
        flipped
        value={panel}
        range={WIDTHS.panel}
        onChange={(width) => widen({ panel: width })}
      />
      <aside className={css.panel} style={{ width: panel }} aria-label="Stage" data-part data-tour="panel">
        <Side />
      </aside>
    </div>
  );
}
