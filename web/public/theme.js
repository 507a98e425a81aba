// The theme of the page before its first paint; shell/preferences.ts keeps it from then on.
{
  let chosen = "system";
  try {
    chosen = JSON.parse(localStorage.getItem("meshforge.desk") ?? "null")?.theme;
  } catch {
    // what cannot be read is as at first
  }
  const system = matchMedia("(prefers-color-scheme: dark)").matches ? "dark" : "light";
  document.documentElement.dataset.theme = chosen === "dark" || chosen === "light" ? chosen : system;
}
