// What to show of the family: words to find, how it should stand, in which order.
import { ArrowDownUp, Images, Search, X } from "lucide-react";
import { type Filters as FiltersState, type LayoutState, setFilters, setLayout, useLayout, useWorkspace } from "../store/workspace";
import { countByFilter, FILTERS } from "../store/family";
import { useProject } from "../store/project";
import { IconButton } from "../ui/Button";
import { choiceLines, Menu } from "../ui/Menu";
import { SIGNS } from "./cardText";
import css from "./family.module.css";

const SORTS: Readonly<Record<FiltersState["sort"], string>> = {
  name: "By name",
  hulls: "Most hulls first",
  unlabelled: "Most without a label first",
  unsure: "Most unsure labels first",
  changed: "Most changed first",
  findings: "Worst by the checks first",
  probability: "Least sure first",
};

const SIZES: Readonly<Record<LayoutState["thumbnails"], string>> = {
  small: "Small pictures",
  middle: "Middle pictures",
  large: "Large pictures",
};

export function Filters() {
  return (
    <div className={css.filters}>
      <SearchField />
      <Chips />
    </div>
  );
}

function SearchField() {
  const { search, sort } = useWorkspace((workspace) => workspace.filters);
  const thumbnails = useLayout((layout) => layout.thumbnails);
  return (
    <div className={css.search}>
      <Search size={14} aria-hidden />
      <input
        type="search"
        placeholder="Find by name or label"
        aria-label="Find assets by name or label"
        value={search}
        onChange={(event) => setFilters({ search: event.target.value })}
        onKeyDown={(event) => event.key === "Escape" && (search ? setFilters({ search: "" }) : event.currentTarget.blur())}
      />
      {search && <IconButton icon={X} name="Clear" onClick={() => setFilters({ search: "" })} />}
      <Menu
        trigger={<IconButton icon={ArrowDownUp} name={`Order: ${SORTS[sort].toLowerCase()}`} />}
        lines={choiceLines(SORTS, sort, (value) => setFilters({ sort: value, chosen: true }))}
      />
      <Menu
        trigger={<IconButton icon={Images} name={SIZES[thumbnails]} />}
        lines={choiceLines(SIZES, thumbnails, (value) => setLayout({ thumbnails: value }))}
      />
    </div>
  );
}

/** A chip for each way to stand that some asset has; several together show any of them. */
function Chips() {
  const only = useWorkspace((workspace) => workspace.filters.only);
  const engine = useWorkspace((workspace) => workspace.checks.engine);
  const confidence = useProject((state) => state.confidence);
  const counts = countByFilter(useProject((state) => state.cards), engine, confidence);
  const there = FILTERS.filter((name) => counts[name] > 0 || only.includes(name));
  if (there.length === 0) return null;
  return (
    <div className={css.chips} role="group" aria-label="Show only">
      {there.map((name) => {
        const { Icon, meaning } = SIGNS[name];
        const on = only.includes(name);
        return (
          <button
            key={name}
            type="button"
            className={css.chip}
            aria-pressed={on}
            data-badge={name}
            title={`${on ? `Do not show only ${name}` : `Show only ${name}`}: ${meaning}`}
            onClick={() => setFilters({ only: on ? only.filter((one) => one !== name) : [...only, name] })}
          >
            <Icon size={12} aria-hidden />
            {name} <b>{counts[name]}</b>
          </button>
        );
      })}
    </div>
  );
}
