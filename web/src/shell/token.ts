// The token that the server asks for: from the address, kept in this tab, and out of sight.
import { useToken as keep } from "../server/http";

const KEY = "meshforge.token";

/** Takes the token of the address, or else the one that this tab had before. */
export function takeToken(): void {
  const here = new URL(location.href);
  const given = here.searchParams.get("token");
  if (given !== null) {
    sessionStorage.setItem(KEY, given);
    here.searchParams.delete("token");
    history.replaceState(null, "", here);
  }
  keep(given ?? sessionStorage.getItem(KEY) ?? "");
}
