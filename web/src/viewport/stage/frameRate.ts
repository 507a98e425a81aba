// Keeps the picture moving where drawing is slow: coarse while the camera moves, fine once it rests.

const SLOW = 0.04;
const REST = 0.16;
const PAUSE = 0.3;
const SHARE = 0.5;

export class FrameRate {
  /** How long frames took lately while all was drawn [s]. */
  private taken = 0;
  private last = -Infinity;
  private moved = -Infinity;
  private heavy = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  /** rested: called when the camera has come to rest after it was drawn coarsely. */
  constructor(private readonly rested: () => void) {}

  /** The camera is moved; now: [s]. */
  move(now: number): void {
    this.moved = now;
    if (!this.heavy) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(this.rested, 1000 * REST);
  }

  /** Another asset may be drawn faster. */
  restart(): void {
    this.heavy = false;
    this.taken = 0;
  }

  /** The share of the pixels in each direction that a frame that begins now is to have; below 1 it is coarse. */
  begin(now: number): number {
    const moves = now - this.moved < REST;
    const apart = now - this.last;
    this.last = now;
    if (moves && apart < PAUSE && !this.heavy) {
      this.taken = 0.6 * this.taken + 0.4 * apart;
      this.heavy = this.taken > SLOW;
      if (this.heavy) this.move(this.moved);
    }
    return moves && this.heavy ? SHARE : 1;
  }

  stop(): void {
    clearTimeout(this.timer);
  }
}
