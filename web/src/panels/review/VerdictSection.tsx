// Accept or flag the output of an asset, with a note.
import { Check, Flag, SkipForward, Undo2 } from "lucide-react";
import { useState } from "react";
import { accept, flag, nextToReview, noteFlag, takeBackReview } from "../../commands/reviewing";
import { useProject } from "../../store/project";
import { shortName } from "../../store/words";
import type { Card } from "../../wire";
import { Button } from "../../ui/Button";
import { Section } from "../../ui/Section";
import css from "./review.module.css";

export function VerdictSection({ asset }: { asset: string }) {
  const card = useProject((state) => state.cards[asset]);
  const some = useProject((state) => Object.values(state.cards).some(({ output }) => output !== "none"));
  if (!card) return null;
  const written = card.output === "edited" || card.output === "unchanged";
  const stale = card.stale.length > 0;
  return (
    <Section title={shortName(asset)} aside={<Standing card={card} />}>
      <div className={css.row}>
        {written && card.review !== "accepted" && (
          <Button
            look={stale ? "plain" : "primary"}
            icon={Check}
            disabled={stale}
            tip={stale ? "It is not up to date: apply first" : "Accept, and go to the next that wants a look"}
            keys="Y"
            onClick={() => void accept(asset)}
          >
            Accept
          </Button>
        )}
        {written && card.review !== "flagged" && (
          <Button icon={Flag} tip="Flag it for another look" keys="F" onClick={() => void flag(asset, card.note)}>
            Flag
          </Button>
        )}
        {card.review && (
          <Button icon={Undo2} onClick={() => void takeBackReview(asset)}>
            {card.review === "accepted" ? "Not accepted" : "Take flag back"}
          </Button>
        )}
        {some && (
          <Button look="quiet" icon={SkipForward} tip="The next that failed, is flagged, or not reviewed" keys="N" onClick={nextToReview}>
            Next
          </Button>
        )}
      </div>
      {card.review === "flagged" && <NoteField key={card.note ?? ""} card={card} />}
    </Section>
  );
}

function Standing({ card }: { card: Card }) {
  if (card.review === "accepted") return <span className={css.good}>✓ accepted</span>;
  if (card.review === "flagged") return <span className={css.warn}>⚑ flagged</span>;
  if (card.output === "failed") return <span className={css.bad}>✗ failed</span>;
  return <>{card.output === "none" ? "not applied yet" : "not reviewed"}</>;
}

function NoteField({ card }: { card: Card }) {
  const [note, setNote] = useState(card.note ?? "");
  const keep = () => {
    if (note.trim() !== (card.note ?? "")) void noteFlag(card.asset, note.trim() || null);
  };
  return (
    <input
      className={css.field}
      aria-label="Why it is flagged"
      placeholder="What is wrong with it? (Enter keeps the note)"
      value={note}
      onChange={(event) => setNote(event.target.value)}
      onBlur={keep}
      onKeyDown={(event) => event.key === "Enter" && event.currentTarget.blur()}
    />
  );
}
