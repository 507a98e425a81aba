// What is said when there is no connection: before the first word of the server, and after it is lost.
import { Copy, Unplug } from "lucide-react";
import { useEffect } from "react";
import { useUnsaved } from "../store/edits";
import { countText } from "../store/words";
import { Button } from "../ui/Button";
import { Wordmark } from "../ui/Wordmark";
import { type NoConnection, startCommand, useConnection } from "./connection";
import css from "./connection.module.css";

const REASONS = {
  lost: "Connection lost; trying again.",
  refused: "Another studio answers here now. Open the address that the terminal shows.",
  elsewhere: "The studio does not have the project of this page open.",
};

export function ConnectionBar() {
  const state = useConnection((connection) => connection.state);
  const unsaved = useUnsaved(({ count }) => count);
  useEffect(() => {
    if (!unsaved) return;
    const warn = (event: BeforeUnloadEvent) => event.preventDefault();
    addEventListener("beforeunload", warn);
    return () => removeEventListener("beforeunload", warn);
  }, [unsaved]);
  if (state === "connecting" || state === "open") return null;
  const kept = unsaved ? `${countText(unsaved, "edit")} of this page ${unsaved === 1 ? "waits" : "wait"} to be saved.` : "All edits are saved.";
  return (
    <div className={css.bar} role="alert" data-state={state}>
      <Unplug size={14} aria-hidden />
      <Reason state={state} /> {kept}
    </div>
  );
}

/** Why there is no connection, and what to do. */
function Reason({ state }: { state: NoConnection }) {
  const why = useConnection((connection) => connection.why);
  if (state !== "stopped") return <span>{[REASONS[state], state === "elsewhere" && why].filter(Boolean).join(" ")}</span>;
  const command = startCommand();
  return (
    <>
      <span>
        The studio was stopped. Start it again by <code>{command}</code>: this page goes on by itself.
      </span>
      <Button icon={Copy} onClick={() => void navigator.clipboard.writeText(command)}>
        Copy
      </Button>
    </>
  );
}

/** The window until the project is known. */
export function Welcome() {
  const state = useConnection((connection) => connection.state);
  return (
    <div className={css.welcome}>
      <Wordmark large />
      {state === "connecting" || state === "open" ? (
        <p role="status" className={css.opening}>
          Opening the project…
        </p>
      ) : (
        <div role="alert">
          <Reason state={state} />
        </div>
      )}
    </div>
  );
}
