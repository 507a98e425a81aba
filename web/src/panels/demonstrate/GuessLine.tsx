// What the program would select for an open rule: to be accepted, corrected, or answered with nothing.
import { inTurn } from "../../commands/turns";
import { draftStep } from "../../store/beginning";
import { acceptGuess } from "../../store/guesses";
import { complainedOf } from "../../store/toasts";
import { say } from "../../steps/stepMenu";
import { Button } from "../../ui/Button";
import { counted } from "../../store/words";
import type { AssetView, Guess } from "../../wire";
import css from "./demonstrate.module.css";

interface GuessLineProps {
  guess: Guess | undefined;
  view: AssetView;
  place: number;
  isNext: boolean;
}

export function GuessLine({ guess, view, place, isNext }: GuessLineProps) {
  const sound = guess?.error === null ? guess : undefined;
  const count = sound?.select.length ?? 0;
  return (
    <div className={css.guess}>
      {guess?.error && <p className={css.hint}>No guess: {guess.error}</p>}
      {sound && <p title={sound.sentence}>Probably {count ? counted(count, "hull") : "nothing here"}</p>}
      <div className={css.buttons}>
        {sound && (
          <Button
            look={isNext ? "primary" : "plain"}
            keys={isNext ? "Enter" : undefined}
            tip="Take the guess as the step"
            onClick={() => inTurn(() => acceptGuess(place + 1).catch(complainedOf))}
          >
            Accept
          </Button>
        )}
        <Button onClick={() => inTurn(() => draftStep(place, sound?.select))} tip="Select the hulls yourself">
          {count ? "Correct…" : "Show it…"}
        </Button>
        {isNext && (count > 0 || !sound) && (
          <Button
            look="quiet"
            onClick={() => inTurn(() => say(view.asset, place, []))}
            tip="The rule selects nothing on this asset"
          >
            Nothing here
          </Button>
        )}
      </div>
    </div>
  );
}
