// A slider with a name.
import { Slider } from "radix-ui";
import css from "./ui.module.css";

export function Slide(props: {
  name: string;
  value: number;
  min?: number;
  max?: number;
  step?: number;
  onChange: (value: number) => void;
}) {
  return (
    <Slider.Root
      className={css.slide}
      value={[props.value]}
      min={props.min ?? 0}
      max={props.max ?? 1}
      step={props.step ?? 0.01}
      onValueChange={([value]) => value !== undefined && props.onChange(value)}
    >
      <Slider.Track className={css.slideTrack}>
        <Slider.Range className={css.slideRange} />
      </Slider.Track>
      <Slider.Thumb className={css.slideThumb} aria-label={props.name} />
    </Slider.Root>
  );
}
