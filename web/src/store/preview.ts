// What the action in hand would make of the asset; set by who asks the server, drawn by the viewport.
import { create } from "zustand";
import type { EditedPacket } from "../server/packet";

export const usePreview = create<{ preview: EditedPacket | null }>()(() => ({ preview: null }));

export function setPreview(preview: EditedPacket | null): void {
  if (usePreview.getState().preview !== preview) usePreview.setState({ preview });
}
