// How hulls are made of what has none: the settings, hulls that are tried on one asset, and making them of all.
import { create } from "zustand";
import type { DecomposeOptions } from "../wire";
import { isRunning, makeHulls, tryHulls } from "./jobs";
import { oncePerFamily, useProject } from "./project";
import { openAsset, setLayout, useWorkspace, visit } from "./workspace";

interface DecomposeState {
  options: DecomposeOptions;
  /** The asset beside whose view they are asked for, though it has hulls. */
  open: string | null;
  /** The job that tried hulls last, and with which settings. */
  tried: { id: string; asset: string; options: DecomposeOptions } | null;
}

export const useDecompose = create<DecomposeState>()(() => ({ options: { method: null, by: "whole", most: null, threshold: null }, open: null, tried: null }));

export const setOptions = (some: Partial<DecomposeOptions>): void => useDecompose.setState(({ options }) => ({ options: { ...options, ...some } }));

/** The number that a person typed, as far as it is one within its limits; null where there is none. */
export function parseLimit(text: string, low: number, high: number): number | null {
  const value = Number(text);
  return text.trim() && Number.isFinite(value) ? Math.min(Math.max(value, low), high) : null;
}

/** Assets that have geometry, yet no hulls. */
export const listBare = oncePerFamily((cards) => cards.filter((card) => card.hulls === 0 && card.sources > 0).map((card) => card.asset));

/** Why no hulls can be made, null where they can. */
export function whyNotDecompose(): string | null {
  const { cards, jobs } = useProject.getState();
  if (isRunning(jobs, "decompose")) return "Hulls are being made now.";
  return listBare(cards).length ? null : "Every asset has hulls.";
}

/** Whether hulls were made for some assets before: those of others are made alike unless a person says how. */
export const useIsBegun = (): boolean => useProject(({ cards }) => isBegun(cards));
const isBegun = oncePerFamily((cards) => cards.some((card) => card.prepared.length > 0));

/** The settings as they are sent: by CoACD where nobody says how, and nothing was made before. */
export function chosenOptions(): DecomposeOptions {
  const { options } = useDecompose.getState();
  return options.method === null && isBegun(useProject.getState().cards) ? {} : { ...options, method: options.method ?? "coacd" };
}

/** Asks how hulls are to be made, beside the view of an asset. */
export function openDecompose(asset: string): void {
  setLayout({ gallery: false });
  openAsset(asset);
  useDecompose.setState({ open: asset });
}

/** Shows an asset as it is, without hulls that were tried. */
export function closeDecompose(): void {
  useDecompose.setState({ open: null, tried: null });
  useWorkspace.setState({ asked: null, showing: { kind: "source" } });
}

/** Makes the hulls of one asset to look at. */
export async function tryOn(asset: string): Promise<void> {
  const { options } = useDecompose.getState(); // what is changed meanwhile was not tried
  const bare = listBare(useProject.getState().cards);
  const id = await tryHulls(asset, bare.includes(asset) ? bare : [asset, ...bare], chosenOptions());
  if (id !== null) useDecompose.setState({ tried: { id, asset, options } });
}

/** Shows the hulls that were tried once they are there, as long as their asset is open. */
export function showTried(): void {
  const { tried } = useDecompose.getState();
  if (tried && useWorkspace.getState().asset === tried.asset) visit(tried.asset, { kind: "hulls", job: tried.id });
}

export function keepHulls(assets: readonly string[]): void {
  makeHulls(assets, chosenOptions());
  closeDecompose();
}
