// Projects that were open before; one that is gone says so and can be taken off the list.
import { FolderOpen, FolderX, X } from "lucide-react";
import { useState } from "react";
import { hueOf } from "../pictures/cssColor";
import { IdPicture } from "../pictures/IdPicture";
import { api } from "../server/api";
import { forgetProject, openProject, useStart } from "../store/start";
import { countText } from "../store/words";
import { IconButton } from "../ui/Button";
import type { RecentProject } from "../wire";
import { FolderButton } from "./FolderDialog";
import { ProblemNote } from "./ProblemNote";
import css from "./start.module.css";
import { openedText } from "./words";

export function RecentProjects() {
  const recent = useStart((state) => state.view?.recent ?? NONE);
  const busy = useStart((state) => state.busy !== null);
  return (
    <section className={css.recent} aria-labelledby="recent-projects">
      <header className={css.head}>
        <h2 id="recent-projects">Recent projects</h2>
        <FolderButton icon={FolderOpen} disabled={busy} title="Open a project" from="" wants="project" onChoose={(folder) => void openProject(folder)}>
          Open…
        </FolderButton>
      </header>
      <ProblemNote place="open" />
      {recent.length === 0 && <p className={css.dim}>None yet. Make one here, or open one that is on this machine.</p>}
      <ul className={css.projects}>
        {recent.map((project) => (
          <Row key={project.folder} project={project} busy={busy} />
        ))}
      </ul>
    </section>
  );
}

const NONE: readonly RecentProject[] = [];

function Row({ project, busy }: { project: RecentProject; busy: boolean }) {
  const { name, folder, gone, assets, opened, state, picture } = project;
  const [now] = useState(Date.now);
  const facts = gone ? "There is no project in this folder any more" : [countText(assets, "asset"), state, openedText(opened, now)].filter(Boolean).join(" · ");
  const words = (
    <>
      {picture ? <IdPicture url={api.recentPicture(folder, picture)} label="" colors={hueOf} className={css.thumb} /> : <span className={css.thumb} />}
      <span className={css.name}>
        {gone && <FolderX size={14} aria-hidden />}
        {name}
      </span>
      <span className={css.path} title={folder}>
        {folder}
      </span>
      <span className={css.facts}>{facts}</span>
    </>
  );
  return (
    <li className={css.project} data-gone={gone}>
      {gone ? (
        <div className={css.open}>{words}</div>
      ) : (
        <button type="button" className={css.open} disabled={busy} onClick={() => void openProject(folder)}>
          {words}
        </button>
      )}
      <IconButton icon={X} name={`Remove ${name} from this list; its files stay`} onClick={() => void forgetProject(folder)} />
    </li>
  );
}
