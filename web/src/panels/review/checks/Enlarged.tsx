// A picture that a click shows large, over everything else.
import { X } from "lucide-react";
import { Dialog } from "radix-ui";
import { IconButton } from "../../../ui/Button";
import css from "./checks.module.css";

/** Not the button in it, whose hint would take the first Escape. */
function focusWhole(event: Event): void {
  event.preventDefault();
  if (event.currentTarget instanceof HTMLElement) event.currentTarget.focus();
}

export function Enlarged({ source, text }: { source: string; text: string }) {
  return (
    <Dialog.Root>
      <Dialog.Trigger className={css.small} title="Show it large">
        <img src={source} alt={text} />
      </Dialog.Trigger>
      <Dialog.Portal>
        <Dialog.Overlay className={css.shade} />
        <Dialog.Content className={css.large} aria-describedby={undefined} onOpenAutoFocus={focusWhole}>
          <header>
            <Dialog.Title>{text}</Dialog.Title>
            <Dialog.Close asChild>
              <IconButton icon={X} name="Close" />
            </Dialog.Close>
          </header>
          <img src={source} alt="" />
        </Dialog.Content>
      </Dialog.Portal>
    </Dialog.Root>
  );
}
