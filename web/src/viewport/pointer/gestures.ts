// Pointer, wheel and touch on the viewport: moves of the camera are done here, all else is handed to the tool in hand.
import type { Stage } from "../stage/stage";
import type { Spot } from "../geometry/region";

/** What a tool does with the left button; spots are pixels of the viewport. */
export interface PointerTool {
  /** Goes on with a drag; null where drags move the camera. */
  begin(spot: Spot, event: PointerEvent): Drag | null;
  click(spot: Spot, event: PointerEvent): void;
  hover(spot: Spot | null): void;
  /** Whether the tool draws regions, from which Alt takes away. */
  drawsRegion(): boolean;
}

export interface Drag {
  move(spot: Spot): void;
  end(event: PointerEvent): void;
  cancel(): void;
}

const SLACK = 4;
const PINCH = 2;

export class Gestures {
  private readonly touches = new Map<number, Spot>();
  private begun: { spot: Spot; last: Spot; far: boolean; camera: "orbit" | "pan" | null; drag: Drag | null } | null = null;

  constructor(
    private readonly element: HTMLElement,
    private readonly stage: Stage,
    private readonly grip: PointerTool,
  ) {}

  /** Listens until the returned function is called. */
  listen(): () => void {
    const stop = new AbortController();
    const on = <K extends keyof HTMLElementEventMap>(kind: K, does: (event: HTMLElementEventMap[K]) => void) =>
      this.element.addEventListener(kind, does, { signal: stop.signal, passive: false });
    on("pointerdown", (event) => this.down(event));
    on("pointermove", (event) => this.move(event));
    on("pointerup", (event) => this.up(event));
    on("pointercancel", (event) => this.cancel(event));
    on("pointerleave", () => !this.begun && this.grip.hover(null));
    on("wheel", (event) => this.wheel(event));
    on("contextmenu", (event) => event.preventDefault());
    return () => stop.abort();
  }

  private down(event: PointerEvent): void {
    const spot = this.spotOf(event);
    this.element.setPointerCapture(event.pointerId);
    if (event.pointerType === "touch") this.touches.set(event.pointerId, spot);
    if (this.touches.size === PINCH) {
      this.begun?.drag?.cancel();
      this.begun = null;
      return;
    }
    if (event.button === 1) event.preventDefault();
    const camera = cameraMove(event, this.grip.drawsRegion());
    const drag = camera ? null : this.grip.begin(spot, event);
    this.begun = { spot, last: spot, far: false, camera, drag };
  }

  private move(event: PointerEvent): void {
    const spot = this.spotOf(event);
    if (this.touches.has(event.pointerId) && this.touches.size === PINCH) return this.pinch(event.pointerId, spot);
    const { begun } = this;
    if (!begun) return this.grip.hover(spot);
    begun.far ||= Math.hypot(spot[0] - begun.spot[0], spot[1] - begun.spot[1]) > SLACK;
    if (!begun.far) return;
    if (begun.drag) begun.drag.move(spot);
    else this.moveCamera(begun.camera ?? "orbit", spot[0] - begun.last[0], spot[1] - begun.last[1]);
    begun.last = spot;
  }

  private up(event: PointerEvent): void {
    const { begun } = this;
    this.touches.delete(event.pointerId);
    this.begun = null;
    if (!begun) return;
    if (begun.far) begun.drag?.end(event);
    else {
      begun.drag?.cancel();
      // with Alt a drag would have moved the camera; a click goes through
      if (event.button === 0 && (!begun.camera || event.altKey)) this.grip.click(begun.spot, event);
    }
  }

  private cancel(event: PointerEvent): void {
    this.touches.delete(event.pointerId);
    this.begun?.drag?.cancel();
    this.begun = null;
  }

  private wheel(event: WheelEvent): void {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 32 : 1;
    const by = Math.max(-240, Math.min(240, event.deltaY * lines));
    const [x, y] = this.spotOf(event);
    this.stage.moveCamera((view) => view.zoom(Math.exp(by * 0.0016), x - this.stage.paneAt(x).x, y));
  }

  /** Two fingers: they move the picture with them, and apart is nearer. */
  private pinch(moved: number, spot: Spot): void {
    const before = [...this.touches.values()];
    this.touches.set(moved, spot);
    const after = [...this.touches.values()];
    const [b, a] = [middleAndSpan(before), middleAndSpan(after)];
    this.stage.moveCamera((view) => {
      view.pan(a.x - b.x, a.y - b.y);
      view.zoom(b.span / Math.max(a.span, 1), a.x - this.stage.paneAt(a.x).x, a.y);
    });
  }

  private moveCamera(how: "orbit" | "pan", dx: number, dy: number): void {
    this.stage.moveCamera((view) => (how === "orbit" ? view.orbit(dx, dy) : view.pan(dx, dy)));
  }

  private spotOf(event: MouseEvent): Spot {
    const { left, top } = this.element.getBoundingClientRect();
    return [event.clientX - left, event.clientY - top];
  }
}

/** Which camera move a press begins: right pans, middle orbits or with shift pans, Alt and left orbits. */
function cameraMove({ button, shiftKey, altKey }: PointerEvent, drawsRegion: boolean): "orbit" | "pan" | null {
  if (button === 2) return "pan";
  if (button === 1) return shiftKey ? "pan" : "orbit";
  return altKey && !drawsRegion ? "orbit" : null;
}

function middleAndSpan(spots: readonly Spot[]): { x: number; y: number; span: number } {
  const [a, b] = [spots[0] ?? [0, 0], spots[1] ?? [0, 0]];
  return { x: (a[0] + b[0]) / 2, y: (a[1] + b[1]) / 2, span: Math.hypot(a[0] - b[0], a[1] - b[1]) };
}
