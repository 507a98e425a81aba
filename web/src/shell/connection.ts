// Connects the stores to the server, and knows why there is no connection.
import { create } from "zustand";
import { getJson, ServerProblem } from "../server/http";
import { listen } from "../server/socket";
import { openAsset, openStage } from "../store/desk";
import { follow } from "../store/following";
import { receive, useProject } from "../store/project";
import type { Event } from "../wire";
import { place, rememberPlace } from "./place";

/** refused: the server is another one than that whose token this page has. */
export const useConnection = create<{ state: "connecting" | "open" | "lost" | "refused" }>()(() => ({
  state: "connecting",
}));

export function connect(): void {
  let followed = false;
  function heard(event: Event): void {
    receive(event);
    if (followed || event.kind !== "hello") return;
    followed = true;
    follow();
    goWhereOneWas();
    rememberPlace();
  }
  listen({ receive: heard, connected });
}

function connected(is: boolean): void {
  useProject.setState({ connected: is });
  if (is) useConnection.setState({ state: "open" });
  else void whyNot().then((state) => !useProject.getState().connected && useConnection.setState({ state }));
}

async function whyNot(): Promise<"lost" | "refused"> {
  try {
    await getJson("api/language");
    return "lost";
  } catch (error) {
    return error instanceof ServerProblem && (error.status === 401 || error.status === 403) ? "refused" : "lost";
  }
}

/** Opens what this tab had open before it was loaded again, or what is next. */
function goWhereOneWas(): void {
  const { cards, order, project } = useProject.getState();
  const before = place();
  openStage(before.stage ?? project.next.stage);
  const known = before.asset !== null && before.asset in cards ? before.asset : null;
  const readable = order.find((asset) => cards[asset]?.error === null && cards[asset].hulls !== 0);
  openAsset(known ?? project.next.asset ?? readable ?? order[0] ?? null);
}
