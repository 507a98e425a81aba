// The action in hand, done to the result: a preview, and Enter keeps it as an edit by hand.
import { useEffect } from "react";
import { showPresent } from "../../commands/reviewing";
import { useDesk } from "../../store/desk";
import { followPreview } from "../../store/previewing";
import { DraftForm } from "../demonstrate/DraftForm";
import css from "./review.module.css";

export function CorrectForm({ asset }: { asset: string }) {
  useEffect(() => {
    // hulls are named as the program leaves them now, so that is what must be in view
    const { showing } = useDesk.getState();
    if (showing.kind !== "result" || showing.of !== "program") showPresent(asset);
    return followPreview(true);
  }, [asset]);
  return (
    <div className={css.correcting} ref={toView}>
      <p className={css.dim}>Select hulls of the result; the edit is kept for this asset alone, and done again after the program.</p>
      <DraftForm />
    </div>
  );
}

function toView(form: HTMLElement | null): void {
  form?.scrollIntoView({ block: "nearest" });
}
