// The page before a project is open: what MeshForge does above; recent projects on the left, a new one on the right.
import { DropZone } from "../family/AddAssets";
import { uploadForProject, useStart } from "../store/start";
import { ThemeMenu } from "../ui/ThemeMenu";
import { Wordmark } from "../ui/Wordmark";
import { Intro } from "./Intro";
import { NewProject } from "./NewProject";
import { RecentProjects } from "./RecentProjects";
import css from "./start.module.css";

export function StartPage() {
  const version = useStart((state) => state.view?.version);
  return (
    <div className={css.page} data-testid="start">
      <header className={css.bar}>
        <Wordmark />
        <span className={css.version}>{version}</span>
        <ThemeMenu />
      </header>
      <main className={css.main}>
        <h1 className="visually-hidden">Projects</h1>
        <Intro />
        <RecentProjects />
        <NewProject />
      </main>
      <DropZone words="Drop to make a project of these files" take={uploadForProject} />
    </div>
  );
}
