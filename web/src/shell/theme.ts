// Light or dark: what the person chose, or what the system has.
import { useDesk } from "../store/desk";

const dark = window.matchMedia("(prefers-color-scheme: dark)");

/** Dresses the page now, and whenever choice or system change. */
export function dress(): void {
  const wear = () => {
    const { theme } = useDesk.getState();
    document.documentElement.dataset.theme = theme === "system" ? (dark.matches ? "dark" : "light") : theme;
  };
  wear();
  useDesk.subscribe((now, before) => now.theme !== before.theme && wear());
  dark.addEventListener("change", wear);
}
