// Short messages at the foot of the right column, which they shorten, so that they lie over nothing: what was done
// fades, what went wrong stays until it is mended or closed, or for a minute in which a person did something.
import { Check, CircleX, X } from "lucide-react";
import { useEffect, useState } from "react";
import { undo } from "../store/edits";
import { dismissToast, reportError, type Toast, useToasts } from "../store/toasts";
import { Button, IconButton } from "../ui/Button";
import { whilePointed } from "../ui/whilePointed";
import css from "./toasts.module.css";

const FADES_AFTER = { done: 6000, problem: 60_000 }; // ms

let lastAct = 0;
for (const kind of ["pointermove", "keydown"]) addEventListener(kind, () => (lastAct = Date.now()), { passive: true, capture: true });

// what went wrong where nobody waited for it
addEventListener("unhandledrejection", (event) => {
  event.preventDefault();
  reportError(event.reason);
});

export function Toasts() {
  const toasts = useToasts((state) => state.toasts);
  return (
    <div className={css.toasts} data-testid="toasts">
      <div role="status" aria-live="polite">
        {toasts.filter((toast) => toast.kind === "done").map(line)}
      </div>
      <div role="alert" aria-live="assertive">
        {toasts.filter((toast) => toast.kind === "problem").map(line)}
      </div>
    </div>
  );
}

const line = (toast: Toast) => <ToastLine key={toast.id} toast={toast} />;

function ToastLine({ toast }: { toast: Toast }) {
  const [held, setHeld] = useState(false);
  useEffect(() => {
    if (held) return;
    const since = Date.now();
    const end = () => (toast.kind === "done" || lastAct > since) && dismissToast(toast.id);
    const timer = setInterval(end, FADES_AFTER[toast.kind]);
    return () => clearInterval(timer);
  }, [held, toast]);
  const Icon = toast.kind === "done" ? Check : CircleX;
  return (
    <div className={css.toast} data-kind={toast.kind} {...whilePointed(() => setHeld(true), () => setHeld(false))}>
      <Icon size={16} aria-label={toast.kind === "done" ? "Done" : "Problem"} />
      <div className={css.words}>
        <p>{toast.text}</p>
        {toast.remedy && <p className={css.remedy}>{toast.remedy}</p>}
      </div>
      {toast.undo && (
        <Button
          keys="Ctrl+Z"
          onClick={() => {
            dismissToast(toast.id);
            void undo();
          }}
        >
          Undo
        </Button>
      )}
      <IconButton icon={X} name="Dismiss" {...(toast.kind === "problem" && { keys: "Escape" })} onClick={() => dismissToast(toast.id)} />
    </div>
  );
}
