// The window, fetched while the server is asked for the project and the asset to show.
import { createRoot } from "react-dom/client";
import { App } from "./shell/App";
import { bindKeys } from "./shell/keys";
import { getCanvas } from "./viewport/canvas";

export function open(root: HTMLElement): void {
  bindKeys();
  createRoot(root).render(<App />);
  // what takes longest is begun while the server looks up the project
  getCanvas();
}
