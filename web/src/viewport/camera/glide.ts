// A short smooth move from one pose to another.
import { between, type Pose } from "./pose";

const SECONDS = 0.22;

export class Glide {
  private constructor(
    private readonly from: Pose,
    private readonly to: Pose,
    private readonly began: number,
  ) {}

  /** A move that begins now; one that is over at once where motion is to be reduced. */
  static start(from: Pose, to: Pose, now: number): Glide {
    return new Glide(from, to, reducesMotion() ? -Infinity : now);
  }

  /** Where it is, and whether it has arrived; now: [s]. */
  at(now: number): { pose: Pose; done: boolean } {
    const share = Math.min(1, (now - this.began) / SECONDS);
    if (share >= 1) return { pose: this.to, done: true };
    return { pose: between(this.from, this.to, 1 - (1 - share) ** 3), done: false };
  }
}

const reducesMotion = (): boolean => matchMedia("(prefers-reduced-motion: reduce)").matches;
