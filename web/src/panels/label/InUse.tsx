// Why a label cannot be removed, and a way to the hulls that have it.
import { setFilters, setHighlight, useDesk } from "../../store/desk";
import { selectLabel } from "../../store/labelling";
import { useProject } from "../../store/project";
import { counted } from "../../store/words";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import type { VocabularyLabel } from "../../wire";
import css from "./label.module.css";

export function InUse({
  label: { name, used },
  place,
  onClose,
}: {
  label: VocabularyLabel;
  place: number;
  onClose: () => void;
}) {
  return (
    <div className={css.inUse} role="status">
      <Note mood="warn">
        {counted(used, "hull")} {used === 1 ? "has" : "have"} it; give {used === 1 ? "it" : "them"} another label first.
        <div className={css.buttons}>
          <Button look="quiet" onClick={() => reveal(name, place)}>
            Show them
          </Button>
          <Button
            look="quiet"
            onClick={() => {
              conceal(name);
              onClose();
            }}
          >
            Close
          </Button>
        </div>
      </Note>
    </div>
  );
}

/** Selects the hulls with a label, and points them out in the family. */
function reveal(name: string, place: number): void {
  const { cards } = useProject.getState();
  const having = Object.values(cards).map(
    ({ asset, labels }) => [asset, labels.flatMap((label, k) => (label === place ? [k] : []))] as const,
  );
  selectLabel(name);
  setFilters({ search: name });
  setHighlight({ what: name, assets: Object.fromEntries(having.filter(([, hulls]) => hulls.length)) });
}

/** The family is as it was before the label was pointed out. */
function conceal(name: string): void {
  const { filters, highlight } = useDesk.getState();
  if (filters.search === name) setFilters({ search: "" });
  if (highlight?.what === name) setHighlight(null);
}
