// Keeps theme, widths and the view's settings in the browser.
import { useDesk } from "../store/desk";
import { initialKept, keptOf, restored } from "../store/kept";
import { useLayout } from "../store/layout";

const KEY = "meshforge.desk";

/** Takes up what was kept, and keeps what changes from now on. */
export function remember(): void {
  const { theme, columns, checks, view, sort, layout } = restored(initialKept, stored());
  useDesk.setState((desk) => ({
    theme,
    columns,
    checks,
    view: { ...desk.view, ...view },
    filters: { ...desk.filters, sort },
  }));
  useLayout.setState(layout);
  let written = localStorage.getItem(KEY);
  let timer: ReturnType<typeof setTimeout> | undefined;
  const write = () => {
    const text = JSON.stringify(keptOf(useDesk.getState(), useLayout.getState()));
    if (text !== written) localStorage.setItem(KEY, (written = text));
  };
  const soon = () => {
    clearTimeout(timer);
    timer = setTimeout(write, 300);
  };
  useDesk.subscribe(soon);
  useLayout.subscribe(soon);
  window.addEventListener("pagehide", write);
}

function stored(): unknown {
  try {
    return JSON.parse(localStorage.getItem(KEY) ?? "null");
  } catch {
    return null;
  }
}
