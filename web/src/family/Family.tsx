// The family as the left column, or in place of the view with larger pictures: how many assets there are, what to show
// of them, and the cards.
import { Boxes, LayoutGrid, PanelLeftClose } from "lucide-react";
import { useShown } from "../store/family";
import { listBare, openDecompose } from "../store/decompose";
import { useIsDecomposing } from "../store/jobs";
import { useProject } from "../store/project";
import { setLayout, useLayout } from "../store/workspace";
import { Button, IconButton } from "../ui/Button";
import { AddMenu } from "./AddAssets";
import { Cards } from "./Cards";
import css from "./family.module.css";
import { Filters } from "./Filters";
import { AssetMenu, LeftOut } from "./Members";
import { SignOff } from "./Sureness";

/** large: in place of the view, with larger pictures. */
export function Family({ large = false }: { large?: boolean }) {
  const any = useProject((state) => state.order.length > 0);
  return (
    <div className={[css.family, large && css.gallery].filter(Boolean).join(" ")} data-tour={large ? "family" : undefined}>
      <FamilyHead />
      <ReadProgress />
      {any && (
        <>
          <MissingHulls />
          <SignOff />
          <Filters />
          <Cards large={large} />
          <LeftOut />
        </>
      )}
    </div>
  );
}

/** The head of the family: its number, adding assets, and how much room it has. */
function FamilyHead() {
  const all = useProject((state) => state.order.length);
  const gallery = useLayout((layout) => layout.gallery);
  const shown = useShown().length;
  return (
    <header className={css.head}>
      <h2>Family</h2>
      <span className={css.count} role="status" aria-label={`${shown} of ${all} assets shown`}>
        {shown === all ? all : `${shown} of ${all}`}
      </span>
      <AddMenu />
      <AssetMenu />
      <IconButton
        icon={LayoutGrid}
        name={gallery ? "Back to the view of one asset" : "Show the family in the centre"}
        keys="Q"
        on={gallery}
        onClick={() => setLayout({ gallery: !gallery })}
      />
      {!gallery && (
        <IconButton icon={PanelLeftClose} name="Hide the family" keys="F9" onClick={() => setLayout({ family: false })} />
      )}
    </header>
  );
}

/** How far the reading of the assets is. */
function ReadProgress() {
  const job = useProject((state) => state.jobs.find((one) => one.kind === "read" && one.state === "running"));
  if (!job) return null;
  return (
    <div className={css.reading} role="status">
      <span>
        {job.title} {job.total > 0 && `${job.done} of ${job.total}`}
      </span>
      <progress value={job.total ? job.done : undefined} max={job.total || 1} aria-label={job.title} />
    </div>
  );
}

/** Assets that have geometry, yet no hulls: making them. */
function MissingHulls() {
  const assets = useProject((state) => listBare(state.cards));
  const making = useIsDecomposing();
  const [first] = assets;
  if (first === undefined || making) return null;
  return (
    <div className={css.notice}>
      <span>{assets.length === 1 ? "One asset has no hulls." : `${assets.length} assets have no hulls.`}</span>
      <Button icon={Boxes} onClick={() => openDecompose(first)}>
        Make them…
      </Button>
    </div>
  );
}
