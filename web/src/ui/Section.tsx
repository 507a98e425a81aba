// A part of a panel under a heading, and the notes in it.
import type { ReactNode } from "react";
import css from "./ui.module.css";

export function Section({ title, aside, children }: { title: string; aside?: ReactNode; children: ReactNode }) {
  return (
    <section className={css.section} aria-label={title}>
      <header className={css.sectionHead}>
        <h3>{title}</h3>
        <div className={css.sectionAside}>{aside}</div>
      </header>
      {children}
    </section>
  );
}

/** A remark with a mood; `role="alert"` for those that must be heard. */
export function Note({ mood = "plain", children }: { mood?: "plain" | "good" | "warn" | "bad"; children: ReactNode }) {
  return (
    <div className={[css.note, css[`note-${mood}`]].join(" ")} role={mood === "bad" ? "alert" : undefined}>
      {children}
    </div>
  );
}

/** What went wrong, and what to do about it. */
export function ProblemNote({ message, remedy, children }: { message: string; remedy: string | null; children?: ReactNode }) {
  return (
    <Note mood="bad">
      {message}
      {remedy && <p className={css.remedy}>{remedy}</p>}
      {children}
    </Note>
  );
}

/** A swatch of a label's colour; fill: as hulls have it. */
export function Swatch({ color, fill = "solid" }: { color: string; fill?: "solid" | "dotted" | "hatched" }) {
  return <span className={css.swatch} data-fill={fill} style={{ backgroundColor: color }} aria-hidden />;
}
