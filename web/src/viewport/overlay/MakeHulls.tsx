// How hulls are made of what has none: settings, a try on the asset in view, then keeping them for it or for all.
import { useEffect } from "react";
import { closeDecompose, keepHulls, listBare, showTried, tryOn, useDecompose } from "../../store/decompose";
import { useIsDecomposing, useJob } from "../../store/jobs";
import { useProject } from "../../store/project";
import { countText } from "../../store/words";
import { Button } from "../../ui/Button";
import { HullSettings } from "../../ui/HullSettings";
import { JobProgress } from "../../ui/JobProgress";
import { Note } from "../../ui/Section";
import css from "./overlay.module.css";

export function MakeHulls({ asset }: { asset: string }) {
  const sources = useProject(({ cards }) => cards[asset]?.sources ?? 0);
  const bare = useProject(({ cards }) => listBare(cards));
  const isOpen = useDecompose(({ open }) => open === asset) && !bare.includes(asset);
  const making = useIsDecomposing();
  const last = useJob("preview");
  const tried = useDecompose((state) => (state.tried?.asset === asset && state.tried.options === state.options ? state.tried : null));
  const job = useJob("decompose");
  const latest = tried && last?.id === tried.id ? last : null;
  const done = latest?.state === "done";
  useEffect(() => {
    if (done) showTried();
  }, [done, tried]);
  const all = bare.length > 1 && bare.includes(asset);
  if (making && job) return <section className={css.message} data-docked aria-label={job.title}><JobProgress job={job} /></section>;
  return (
    <section className={css.message} data-docked aria-labelledby="make-hulls">
      <h3 id="make-hulls">{done ? "Hulls to try: none is kept yet" : "Make hulls"}</h3>
      {!latest && <p>{countText(sources, "piece")} of this asset {sources === 1 ? "is" : "are"} not convex, or has no collision geometry. Its file stays as it is.</p>}
      {latest?.state === "running" ? <JobProgress job={latest} /> : latest && <Note mood={done ? "good" : "bad"}>{latest.message}</Note>}
      <HullSettings />
      <div className={css.choices}>
        <Button look={done ? "plain" : "primary"} disabled={latest?.state === "running"} onClick={() => void tryOn(asset)}>
          {tried || last ? "Try again" : "Try on this asset"}
        </Button>
        {all && (
          <Button look={done ? "primary" : "plain"} onClick={() => keepHulls(bare)}>
            {done ? "Keep for" : "Make for"} all {bare.length}
          </Button>
        )}
        <Button look={done && !all ? "primary" : "plain"} onClick={() => keepHulls([asset])}>
          {done ? "Keep for this one" : "Make for this one"}
        </Button>
        {(done || isOpen) && (
          <Button look="quiet" onClick={closeDecompose}>
            {done ? "Discard" : "Close"}
          </Button>
        )}
      </div>
    </section>
  );
}
