// A row of controls that never wraps: what does not fit is behind a button at its end, with its name.
import { Ellipsis } from "lucide-react";
import { Popover } from "radix-ui";
import { type ReactNode, type RefObject, useLayoutEffect, useRef, useState } from "react";
import { IconButton } from "../../ui/Button";
import { fittingParts } from "./fit";
import css from "./toolbar.module.css";

export interface Part {
  readonly id: string;
  /** What it is for, where it is behind the button. */
  readonly name: string;
  /** Those with the highest stay longest. */
  readonly keep: number;
  /** Whether it takes what room is left. */
  readonly grows?: boolean;
  readonly node: ReactNode;
}

export function FittedRow({ parts }: { parts: readonly Part[] }) {
  const row = useRef<HTMLDivElement>(null);
  const shown = useFitting(row, parts);
  const rest = parts.filter((part) => !shown.has(part.id));
  return (
    <div ref={row} className={css.row}>
      {parts
        .filter((part) => shown.has(part.id))
        .map(({ id, grows, node }) => (
          <div key={id} className={css.part} data-part-id={id} data-grows={grows}>
            {node}
          </div>
        ))}
      {rest.length > 0 && <More parts={rest} />}
    </div>
  );
}

function More({ parts }: { parts: readonly Part[] }) {
  return (
    <Popover.Root>
      <Popover.Trigger asChild>
        <IconButton icon={Ellipsis} name="More of the view" className={css.more} />
      </Popover.Trigger>
      <Popover.Portal>
        <Popover.Content className={css.rest} align="end" sideOffset={5} collisionPadding={8} data-modeless aria-label="More of the view">
          {parts.map(({ id, name, node }) => (
            <div key={id} className={css.restLine} role="group" aria-label={name} data-part-id={id}>
              <span aria-hidden>{name}</span>
              {node}
            </div>
          ))}
        </Popover.Content>
      </Popover.Portal>
    </Popover.Root>
  );
}

/** The ids of the parts that fit, as the width of the row and of what is in it changes. */
function useFitting(row: RefObject<HTMLDivElement | null>, parts: readonly Part[]): ReadonlySet<string> {
  const [shown, setShown] = useState<ReadonlySet<string>>(() => new Set(parts.map((part) => part.id)));
  // what is not in the row keeps the width that it had there
  const widths = useRef(new Map<string, number>());
  useLayoutEffect(() => {
    const element = row.current;
    if (!element) return;
    const measure = () => {
      for (const child of element.querySelectorAll<HTMLElement>(":scope > [data-part-id]")) {
        widths.current.set(child.dataset["partId"] ?? "", widthOf(child));
      }
      const found = fittingParts(parts, widths.current, element.clientWidth);
      setShown((before) => (isSame(before, found) ? before : found));
    };
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    for (const child of element.children) observer.observe(child);
    measure();
    return () => observer.disconnect();
  }, [row, parts, shown]);
  return shown;
}

/** The least width of a part; one that grows says it by its style. */
function widthOf(part: HTMLElement): number {
  return part.dataset["grows"] === "true" ? parseFloat(getComputedStyle(part).minWidth) || 0 : part.offsetWidth;
}

const isSame = (a: ReadonlySet<string>, b: ReadonlySet<string>): boolean => a.size === b.size && [...a].every((id) => b.has(id));
