// A name without what others beside it have, too, cut in its middle where there is no room; a screen reader says it whole.
import css from "./name.module.css";

/** Letters at the end that stay in sight. */
const END = 5;

/** own: what is shown of the text. */
export function Name({ text, own = text }: { text: string; own?: string }) {
  const cut = own.length > 2 * END ? own.length - END : own.length;
  return (
    <>
      <span className={css.name} aria-hidden>
        <span>{own.slice(0, cut)}</span>
        {cut < own.length && <span className={css.end}>{own.slice(cut)}</span>}
      </span>
      <span className="visually-hidden">{text}</span>
    </>
  );
}
