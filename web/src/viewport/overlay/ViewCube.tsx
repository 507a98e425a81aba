// A small cube that turns with the view; its faces look from that side. It is for the pointer: keys and screen readers
// have the same in the menu of standard views and on the number keys.
import { useRef } from "react";
import { lookFrom, type StandardView } from "../../store/workspace";
import { axesOf } from "../camera/pose";
import { useFrame, useStage } from "../stage/context";
import css from "./cube.module.css";

const HALF = 24;
const FACES: readonly { side: StandardView; name: string; turn: string }[] = [
  { side: "front", name: "Front", turn: "rotateX(-90deg)" },
  { side: "back", name: "Back", turn: "rotateZ(180deg) rotateX(-90deg)" },
  { side: "right", name: "Right", turn: "rotateZ(-90deg) rotateX(-90deg)" },
  { side: "left", name: "Left", turn: "rotateZ(90deg) rotateX(-90deg)" },
  { side: "top", name: "Top", turn: "" },
  { side: "bottom", name: "Bottom", turn: "rotateX(180deg)" },
];

export function ViewCube() {
  const stage = useStage();
  const cube = useRef<HTMLDivElement>(null);
  useFrame(() => {
    if (cube.current) cube.current.style.transform = transformOf(stage.view.pose);
  });
  return (
    <div className={css.holder} aria-hidden onMouseDown={(event) => event.preventDefault()}>
      <div ref={cube} className={css.cube}>
        {FACES.map(({ side, name, turn }) => (
          <button
            key={side}
            type="button"
            tabIndex={-1}
            className={css.face}
            style={{ transform: `${turn} translateZ(${HALF}px)` }}
            onClick={() => lookFrom(side)}
          >
            {name}
          </button>
        ))}
      </div>
    </div>
  );
}

/** The scene's axes in the page's, which counts y downwards; the cube is built with the scene's y upwards on its top face. */
function transformOf(pose: Parameters<typeof axesOf>[0]): string {
  const { right, up, eye } = axesOf(pose);
  const column = (axis: 0 | 1 | 2, sign: number) => [sign * right[axis], -sign * up[axis], sign * eye[axis], 0];
  return `matrix3d(${[...column(0, 1), ...column(1, -1), ...column(2, 1), 0, 0, 0, 1].map((n) => n.toFixed(5)).join(",")})`;
}
