// A dialog over the window, of which one is open at a time.
import { Dialog } from "radix-ui";
import type { ReactNode } from "react";
import { useWorkspace } from "../store/workspace";
import css from "./overlay.module.css";

export const close = () => useWorkspace.setState({ overlay: "none" });

export function Overlay({ which, children }: { which: "help" | "palette"; children: ReactNode }) {
  const open = useWorkspace((workspace) => workspace.overlay === which);
  return (
    <Dialog.Root open={open} onOpenChange={(is) => !is && close()}>
      <Dialog.Portal>
        <Dialog.Overlay className={css.shade} />
        <Dialog.Content className={css[which]} aria-describedby={undefined}>
          {children}
        </Dialog.Content>
      </Dialog.Portal>
    </Dialog.Root>
  );
}
