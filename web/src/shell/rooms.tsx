// Temporary while the rooms are being built: mounts those that are there.
import type { ComponentType } from "react";

const modules = import.meta.glob<Record<string, ComponentType>>(
  [
    "../viewport/Viewport.tsx",
    "../viewport/HullList.tsx",
    "../steps/StepStrip.tsx",
    "../panels/label/LabelPanel.tsx",
    "../panels/demonstrate/DemonstratePanel.tsx",
    "../panels/learn/LearnPanel.tsx",
    "../panels/review/ReviewPanel.tsx",
  ],
  { eager: true },
);

function room(path: string): ComponentType {
  const name = path.split("/").pop() ?? "";
  return modules[`../${path}.tsx`]?.[name] ?? (() => null);
}

export const Viewport = room("viewport/Viewport");
export const HullList = room("viewport/HullList");
export const StepStrip = room("steps/StepStrip");
export const LabelPanel = room("panels/label/LabelPanel");
export const DemonstratePanel = room("panels/demonstrate/DemonstratePanel");
export const LearnPanel = room("panels/learn/LearnPanel");
export const ReviewPanel = room("panels/review/ReviewPanel");
