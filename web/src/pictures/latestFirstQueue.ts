// Work of which only a few pieces go on at once; the newest goes first, and what nobody wants any more never begins.

interface Job<T> {
  wishes: number;
  begun: boolean;
  result: Promise<T>;
  begin: () => Promise<void>;
}

export class LatestFirstQueue<T> {
  private readonly pieces = new Map<string, Job<T>>();
  private going = 0;

  constructor(private readonly most: number) {}

  /** Asks for a piece by its name, once for all who ask; `drop` takes the wish back. */
  ask(name: string, work: () => Promise<T>): { result: Promise<T>; drop: () => void } {
    const piece = this.pieces.get(name) ?? this.added(name, work);
    piece.wishes += 1;
    this.pump();
    let dropped = false;
    const drop = () => {
      if (dropped) return;
      dropped = true;
      piece.wishes -= 1;
      if (piece.wishes === 0 && !piece.begun) this.pieces.delete(name);
    };
    return { result: piece.result, drop };
  }

  private added(name: string, work: () => Promise<T>): Job<T> {
    let begin: () => Promise<void> = () => Promise.resolve();
    const result = new Promise<T>((good, bad) => {
      begin = () => work().then(good, bad);
    });
    const piece = { wishes: 0, begun: false, result, begin };
    this.pieces.set(name, piece);
    return piece;
  }

  private pump(): void {
    const [name, newest] = [...this.pieces].findLast(([, piece]) => !piece.begun) ?? [];
    if (name === undefined || !newest || this.going >= this.most) return;
    newest.begun = true;
    this.going += 1;
    void newest.begin().finally(() => {
      this.going -= 1;
      this.pieces.delete(name);
      this.pump();
    });
  }
}
