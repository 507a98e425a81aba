// The three axes as the camera sees them, with their letters.
import { useRef } from "react";
import { axesOf, type Pose } from "../camera/pose";
import { useScenes } from "../../store/scenes";
import { axisShown, dot } from "../../store/vectors";
import { useFrame, useStage } from "../stage/context";
import css from "./tools.module.css";

const LETTERS = ["X", "Y", "Z"] as const;
const REACH = 21; // px
const LETTER = 29;

export function Triad() {
  const stage = useStage();
  const svg = useRef<SVGSVGElement>(null);
  useFrame(() => {
    if (svg.current) place(svg.current, stage.view.pose, useScenes.getState().scene?.view.y_up);
  });
  return (
    <svg ref={svg} className={css.triad} viewBox="-36 -36 72 72" role="img" aria-label="Axes X, Y and Z" data-testid="triad">
      {LETTERS.map((letter) => (
        <g key={letter} data-axis={letter.toLowerCase()}>
          <line x1={0} y1={0} />
          <text>{letter}</text>
        </g>
      ))}
    </svg>
  );
}

/** Puts each axis where the camera sees it; those that point away are drawn first and thinner. */
function place(svg: SVGSVGElement, pose: Pose, yUp?: boolean): void {
  const groups = [...svg.querySelectorAll("g")];
  const seen = axesAsSeen(pose, yUp);
  for (const group of groups) {
    const { x, y, near } = seen["xyz".indexOf(group.dataset["axis"] ?? "")] ?? { x: 0, y: 0, near: 0 };
    const [line, letter] = group.children;
    line?.setAttribute("x2", (REACH * x).toFixed(1));
    line?.setAttribute("y2", (REACH * y).toFixed(1));
    line?.setAttribute("stroke-width", near < -0.01 ? "1.4" : "2.2");
    letter?.setAttribute("x", (LETTER * x).toFixed(1));
    letter?.setAttribute("y", (LETTER * y).toFixed(1));
  }
  const far = (group: SVGGElement) => seen["xyz".indexOf(group.dataset["axis"] ?? "")]?.near ?? 0;
  const order = [...groups].sort((a, b) => far(a) - far(b));
  if (order.some((group, k) => group !== groups[k])) svg.append(...order);
}

/** The ends of the axes of length one: to the right and down on the screen, and towards the eye; yUp: whether Y is shown
 * as up. */
export function axesAsSeen(pose: Pose, yUp = false): readonly { x: number; y: number; near: number }[] {
  const { right, up, eye } = axesOf(pose);
  return (["x", "y", "z"] as const).map((axis) => {
    const end = axisShown(axis, yUp);
    return { x: dot(end, right), y: -dot(end, up), near: dot(end, eye) };
  });
}
