// What an asset says about a rule: the step is sent, and remembered so that it is not offered again.
import { create } from "zustand";
import { useProject } from "./project";
import { actionOf, changeSteps, shown, takenAway } from "./steps";

interface SayingState {
  /** The step that was last sent or put down; it is not offered until the asset is another. */
  last: string;
  /** Steps that were left open on purpose; they are not offered. */
  declined: ReadonlySet<string>;
}

export const initialSaying: SayingState = { last: "", declined: new Set() };

export const useSaying = create<SayingState>()(() => initialSaying);

/** Says what a rule selects on an asset: names of hulls, [] for nothing here, null for open. */
export function sayStep(
  asset: string,
  place: number,
  hulls: string[] | null,
  action = actionOf(place),
): Promise<boolean> {
  passOver(asset, place);
  decline(asset, place, hulls === null);
  return changeSteps(asset, shown(place, { select: hulls, action }));
}

/** Takes the step in a place (from 0) away from an asset. */
export function dropStep(asset: string, place: number): Promise<boolean> {
  decline(asset, place, true);
  return changeSteps(asset, takenAway(place));
}

/** Does not offer a step until the server says that the asset changed. */
export function passOver(asset: string, place: number): void {
  useSaying.setState({ last: stateKey(asset, place) });
}

export const isPassedOver = (asset: string, place: number): boolean =>
  useSaying.getState().last === stateKey(asset, place);

export const isDeclined = (asset: string, place: number): boolean =>
  useSaying.getState().declined.has(key(asset, place));

function decline(asset: string, place: number, is: boolean): void {
  const declined = new Set(useSaying.getState().declined);
  if (is) declined.add(key(asset, place));
  else declined.delete(key(asset, place));
  useSaying.setState({ declined });
}

const key = (asset: string, place: number): string => `${asset}\n${place}`;

/** A step of an asset as it is now; another one once the asset changed. */
const stateKey = (asset: string, place: number): string =>
  `${key(asset, place)}\n${useProject.getState().revisions[asset] ?? 0}`;
