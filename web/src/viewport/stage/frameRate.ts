// Keeps the picture moving where drawing is slow: coarse while the camera moves, fine once it rests.

const SLOW = 0.04;
const REST = 0.16;
const PAUSE = 0.3;
/** Timers are less exact than this. */
const LATE = 0.01;
const SHARE = 0.5;

export class FrameRate {
  /** How long frames took lately while all was drawn [s]. */
  private taken = 0;
  private last = -Infinity;
  private moved = -Infinity;
  private heavy = false;
  /** Whether the last frame was one of a move. */
  private moving = false;
  private timer: ReturnType<typeof setTimeout> | undefined;

  private settles = -Infinity;
  /** Whether the first frame of another asset is still to be drawn. */
  private waits = false;

  /** rested: called when it has come to rest after it was drawn coarsely; slow: whether drawing always is. */
  constructor(
    private readonly rested: () => void,
    private readonly slow = false,
  ) {}

  /** The camera is moved; now: [s]. */
  move(now: number): void {
    this.moved = now;
    this.rest(now);
  }

  /** What is shown is another one: its first frame is to be quick; now: [s]. */
  settle(now: number): void {
    this.waits = this.slow;
    this.rest(now);
  }

  private rest(now: number): void {
    this.settles = now + REST;
    if (!this.heavy && !this.slow) return;
    clearTimeout(this.timer);
    this.timer = setTimeout(this.rested, 1000 * (REST + LATE));
  }

  /** Whether there is time for shadows in a frame that begins now. */
  hasTime(now: number): boolean {
    return now >= this.settles || (!this.heavy && !this.slow);
  }

  /** Another asset may be drawn faster. */
  restart(): void {
    this.heavy = false;
    this.taken = 0;
  }

  /** The share of the pixels in each direction that a frame that begins now is to have; below 1 it is coarse, as also
   * the first of another asset where drawing is slow. */
  begin(now: number): number {
    const isOfMove = this.moved > this.last;
    const moves = isOfMove || now - this.moved < REST;
    const apart = now - this.last;
    this.last = now;
    const isFirst = this.waits;
    this.waits = false;
    if (isFirst || isOfMove) this.rest(now); // however late it comes
    // on a processor the picture is also drawn as the hand pauses: without such a frame it did not, however late this one comes
    if (moves && (apart < PAUSE || (this.slow && this.moving)) && !this.heavy) {
      this.taken = 0.6 * this.taken + 0.4 * apart;
      this.heavy = this.taken > SLOW;
      if (this.heavy) this.rest(now);
    }
    this.moving = moves;
    return (moves && this.heavy) || isFirst ? SHARE : 1;
  }

  stop(): void {
    clearTimeout(this.timer);
  }
}
