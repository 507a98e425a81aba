// The look that the page has now, so that what is drawn by hand is drawn again when it changes.
import { useSyncExternalStore } from "react";

function watch(changed: () => void): () => void {
  const observer = new MutationObserver(changed);
  observer.observe(document.documentElement, { attributes: true, attributeFilter: ["data-theme"] });
  return () => observer.disconnect();
}

export const useLook = (): string =>
  useSyncExternalStore(watch, () => document.documentElement.dataset.theme ?? "light");
