// The names of assets that are side by side, each at the foot of its asset.
import { useRef } from "react";
import { cutMiddle } from "../../store/commonParts";
import { useOwnNames } from "../../store/project";
import type { ScenePart } from "../../store/scene";
import { useScenes } from "../../store/scenes";
import { useFrame, useStage } from "../stage/context";
import css from "./selectionBar.module.css";

/** Letters of a name; assets are near each other. */
const MOST = 24;

export function SheetNames({ parts }: { parts: readonly ScenePart[] }) {
  const stage = useStage();
  const ownName = useOwnNames();
  const open = useScenes(({ scene }) => scene?.asset);
  const holder = useRef<HTMLDivElement>(null);
  useFrame(() => {
    const pane = stage.panes().at(-1);
    const elements = holder.current?.children;
    if (!pane || !elements) return;
    parts.forEach(({ low, high }, k) => {
      const element = elements[k];
      if (!(element instanceof HTMLElement)) return;
      // the lowest that is seen of its box
      const corners = [0, 1, 2, 3].map((c) => stage.pixelOf([c & 1 ? high[0] : low[0], c & 2 ? high[1] : low[1], low[2]], pane));
      const left = corners.reduce((sum, { x }) => sum + x / 4, 0);
      element.style.left = `${left}px`;
      element.style.top = `${Math.max(...corners.map(({ y }) => y))}px`;
    });
  });
  return (
    <div ref={holder} className={css.names} aria-hidden>
      {parts.map(({ asset, scale }) => (
        <span key={asset} data-open={asset === open}>
          {cutMiddle(ownName(asset), MOST)}
          {scale !== 1 && ` · drawn ×${Number(scale.toPrecision(2))}`}
        </span>
      ))}
    </div>
  );
}
