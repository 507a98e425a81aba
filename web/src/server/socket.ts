// The WebSocket on which the server sends what changed; it connects again by itself.
import type { Event } from "../wire";
import { socketProtocols } from "./http";

/** The code of a connection that ends because another project is open now, or none: what follows comes by a new one. */
const CHANGED = 4000;

interface Listener {
  receive(event: Event): void;
  lost(): void;
}

/** Listens until the returned function is called. */
export function listen(listener: Listener): () => void {
  let socket: WebSocket | null = null;
  let wait = 250;
  let stopped = false;
  let timer: ReturnType<typeof setTimeout> | undefined;

  function connect(): void {
    const here = new URL("ws", document.baseURI);
    here.protocol = here.protocol.replace("http", "ws");
    socket = new WebSocket(here, socketProtocols());
    socket.onopen = () => (wait = 250);
    socket.onmessage = (message: MessageEvent<string>) => listener.receive(JSON.parse(message.data) as Event);
    socket.onclose = (event: CloseEvent) => {
      if (stopped) return;
      if (event.code === CHANGED) return connect();
      listener.lost();
      timer = setTimeout(connect, wait);
      wait = Math.min(2 * wait, 4000);
    };
  }
  connect();
  return () => {
    stopped = true;
    clearTimeout(timer);
    socket?.close();
  };
}
