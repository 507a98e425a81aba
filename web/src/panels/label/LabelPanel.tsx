// The stage in which hulls get labels: the vocabulary, what is not sure, and ways to get labels.
import { setBrush, useDesk } from "../../store/desk";
import { Button } from "../../ui/Button";
import { Note } from "../../ui/Section";
import { Unsure } from "./Unsure";
import { Vocabulary } from "./Vocabulary";
import { Ways } from "./Ways";
import css from "./label.module.css";

export function LabelPanel() {
  return (
    <div className={css.panel} data-tour="labels">
      <Brush />
      <Vocabulary />
      <Unsure />
      <Ways />
    </div>
  );
}

function Brush() {
  const brush = useDesk((desk) => desk.brush);
  if (brush === null) return null;
  return (
    <div className={css.brush} role="status">
      <Note>
        <span>Painting {brush ? <strong>{brush}</strong> : "labels away"}: click hulls, or drag over them.</span>
        <Button look="quiet" onClick={() => setBrush(null)} keys="Esc" tip="Select again">
          Stop
        </Button>
      </Note>
    </div>
  );
}
