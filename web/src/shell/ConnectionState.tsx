// What is said when there is no connection: before the first word of the server, and after it is lost.
import { Unplug } from "lucide-react";
import { Wordmark } from "../ui/Wordmark";
import { useConnection } from "./connection";
import css from "./connection.module.css";

const REFUSED = "The studio of this page has stopped. Open the address that the terminal shows.";
const LOST = "Connection lost; trying again. Your confirmed edits are saved.";

export function ConnectionBar() {
  const state = useConnection((connection) => connection.state);
  if (state !== "lost" && state !== "refused") return null;
  return (
    <div className={css.bar} role="alert" data-state={state}>
      <Unplug size={14} aria-hidden />
      {state === "lost" ? LOST : REFUSED}
    </div>
  );
}

/** The window until the project is known. */
export function Welcome() {
  const state = useConnection((connection) => connection.state);
  return (
    <div className={css.welcome}>
      <Wordmark large />
      {state === "refused" ? (
        <p role="alert">{REFUSED}</p>
      ) : state === "lost" ? (
        <p role="alert">
          The studio does not answer; trying again. Start it in a terminal: <code>meshforge studio</code>
        </p>
      ) : (
        <p role="status" className={css.opening}>
          Opening the project…
        </p>
      )}
    </div>
  );
}
