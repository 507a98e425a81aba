// The hulls that look like the one under the brush: they are outlined, and a click paints them with it.
import { create } from "zustand";
import { api } from "../server/api";
import { problemOf } from "../server/http";
import { placeOf, sheetName } from "./hullPlaces";
import { ownHulls } from "./labels";
import { useScenes } from "./scenes";
import { useWorkspace } from "./workspace";

/** hull: the one under the brush; others: those that are outlined for it, since when [ms]. */
interface AlikeState {
  readonly hull: string | null;
  readonly others: readonly string[];
  readonly since: number;
}

const NONE: AlikeState = { hull: null, others: [], since: 0 };

export const useAlike = create<AlikeState>()(() => NONE);

/** How long the pointer rests on a hull before look-alikes are asked for, and how long these are seen before they count [ms]. */
const [REST, SEEN] = [60, 120];

/** The hulls that a click on one paints: those that are outlined for it, too, unless it is meant alone. */
export function hullsToPaint(name: string, alone: boolean): readonly string[] {
  const { hull, others, since } = useAlike.getState();
  return alone || hull !== name || performance.now() - since < SEEN ? [name] : [name, ...others];
}

/** Looks for look-alikes of what is under the brush, until the returned function is called. */
export function followBrush(): () => void {
  let timer: ReturnType<typeof setTimeout> | undefined;
  const look = (): void => {
    clearTimeout(timer);
    if (useAlike.getState() !== NONE) useAlike.setState(NONE, true);
    const { brush, hover, stage, tool } = useWorkspace.getState();
    if (brush && hover !== null && stage === "label" && tool === "select") timer = setTimeout(() => void find(hover), REST);
  };
  const stops = [
    useWorkspace.subscribe((now, before) => (now.hover !== before.hover || now.brush !== before.brush) && look()),
    useScenes.subscribe((now, before) => now.scene !== before.scene && useAlike.setState(({ others }) => ({ others: listFree(others) }))),
    () => clearTimeout(timer),
  ];
  return () => stops.forEach((stop) => stop());
}

/** The hulls of some that are in sight, and that no person labelled. */
function listFree(names: readonly string[]): string[] {
  const { hidden } = useWorkspace.getState();
  const free = useScenes.getState().scene?.hulls.filter(({ name, source }) => !hidden.has(name) && source !== "user" && source !== "repair");
  const known = new Set(free?.map(({ name }) => name));
  return names.filter((name) => known.has(name));
}

async function find(hull: string): Promise<void> {
  const { asset, sheet } = useWorkspace.getState();
  const place = sheet.length ? placeOf(hull) : asset === null ? undefined : { asset, hull };
  if (!place || !ownHulls(new Set([hull])).length) return;
  try {
    const { found } = await api.similar({ hulls: [place], assets: sheet.length ? [...sheet] : null, step: 0 });
    const { hover, brush } = useWorkspace.getState();
    if (hover !== hull || !brush) return;
    const names = found.flatMap((one) => one.hulls.map((name) => (sheet.length ? sheetName(one.asset, name) : name)));
    const others = listFree(names).filter((name) => name !== hull);
    if (others.length) useAlike.setState({ hull, others, since: performance.now() });
  } catch (error) {
    problemOf(error); // a click then paints the hull alone
  }
}
