// The bar above: project, search, undo and redo, what works in the background, theme, help.
import { CircleQuestionMark, PanelLeftOpen, Redo2, Search, Undo2 } from "lucide-react";
import { useDesk } from "../store/desk";
import { redo, undo } from "../store/edits";
import { setLayout, useLayout } from "../store/layout";
import { useProject } from "../store/project";
import { IconButton } from "../ui/Button";
import { Jobs } from "./Jobs";
import { ThemeMenu } from "./ThemeMenu";
import css from "./TopBar.module.css";
import { Wordmark } from "./Wordmark";

export function TopBar() {
  const { name, folder } = useProject((state) => state.project);
  const hidden = useLayout((layout) => !layout.family && !layout.gallery);
  return (
    <header className={css.bar} data-part>
      {hidden && (
        <IconButton icon={PanelLeftOpen} name="Show the family" keys="F9" onClick={() => setLayout({ family: true })} />
      )}
      <Wordmark />
      <span className={css.line} aria-hidden />
      <h1 className={css.name} title={folder}>
        {name}
      </h1>
      <SearchButton />
      <History />
      <span className={css.space} />
      <Learning />
      <Jobs />
      <ThemeMenu />
      <IconButton
        icon={CircleQuestionMark}
        name="Keys and help"
        keys="?"
        onClick={() => useDesk.setState({ overlay: "help" })}
      />
    </header>
  );
}

function SearchButton() {
  return (
    <button type="button" className={css.search} onClick={() => useDesk.setState({ overlay: "palette" })}>
      <Search size={14} aria-hidden />
      <span>Find a command or an asset</span>
      <kbd>Ctrl+K</kbd>
    </button>
  );
}

function History() {
  const history = useProject((state) => state.history);
  return (
    <span className={css.history}>
      <IconButton
        icon={Undo2}
        name={history.undo === null ? "Nothing to undo" : `Undo: ${history.undo}`}
        keys="Ctrl+Z"
        disabled={history.undo === null}
        onClick={() => void undo()}
      />
      <IconButton
        icon={Redo2}
        name={history.redo === null ? "Nothing to redo" : `Redo: ${history.redo}`}
        keys="Ctrl+Shift+Z"
        disabled={history.redo === null}
        onClick={() => void redo()}
      />
    </span>
  );
}

function Learning() {
  const learning = useProject((state) => state.learning);
  return (
    <span role="status" className={css.learning}>
      {learning && (
        <span className={css.late}>
          <span className={css.spinner} aria-hidden /> Learning…
        </span>
      )}
    </span>
  );
}
