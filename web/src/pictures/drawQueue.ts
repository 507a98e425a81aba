// Pictures are drawn a few in each frame, so that none takes so long that scrolling stutters.
const MOST = 6; // [ms] of drawing in a frame; at least one picture is drawn

const waiting = new Map<object, () => void>();
let asked = false;

/** Draws a picture in one of the next frames; of one owner only the last. The returned function takes that back. */
export function drawSoon(owner: object, draw: () => void): () => void {
  waiting.set(owner, draw);
  askForFrame();
  return () => {
    if (waiting.get(owner) === draw) waiting.delete(owner);
  };
}

function askForFrame(): void {
  if (asked || !waiting.size) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    drawSome();
    askForFrame();
  });
}

function drawSome(): void {
  const began = performance.now();
  for (const [owner, draw] of waiting) {
    waiting.delete(owner);
    draw();
    if (performance.now() - began > MOST) return;
  }
}
