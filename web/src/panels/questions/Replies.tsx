// The buttons of a card, each with its key.
import { Clock, Crosshair, type LucideIcon } from "lucide-react";
import type { ReactNode } from "react";
import { Button } from "../../ui/Button";
import css from "./questions.module.css";

interface ReplyProps {
  keyName?: string;
  look?: "plain" | "primary" | "quiet";
  icon?: LucideIcon;
  tip?: string;
  onClick: () => void;
  children: ReactNode;
}

/** A reply to a question. */
export function Reply({ keyName, children, ...rest }: ReplyProps) {
  return (
    <Button {...rest} aria-keyshortcuts={keyName}>
      {children}
      {keyName && (
        <kbd className={css.key} aria-hidden>
          {keyName}
        </kbd>
      )}
    </Button>
  );
}

export function ShowReply({ onClick }: { onClick: () => void }) {
  return (
    <Reply keyName="S" look="quiet" icon={Crosshair} tip="Open the asset with the hulls in question" onClick={onClick}>
      Show
    </Reply>
  );
}

export function LaterReply({ onClick }: { onClick: () => void }) {
  const tip = "Asks another question; this one does not come back as long as nothing changes";
  return (
    <Reply keyName="L" look="quiet" icon={Clock} tip={tip} onClick={onClick}>
      Later
    </Reply>
  );
}
