// A name that loses first what others beside it have, too, and last what it has alone; a screen reader says it whole.
import { type CommonParts, splitName } from "../store/commonParts";
import css from "./name.module.css";

export function Name({ text, parts, hidden = false }: { text: string; parts: CommonParts; hidden?: boolean }) {
  const [head, own, end, tail] = splitName(text, parts);
  return (
    <>
      <span className={css.name} aria-hidden>
        {head && <span className={css.common}>{head}</span>}
        <span className={css.own}>{own}</span>
        {end && <span className={css.end}>{end}</span>}
        {tail && <span className={css.common}>{tail}</span>}
      </span>
      {!hidden && <span className="visually-hidden">{text}</span>}
    </>
  );
}
