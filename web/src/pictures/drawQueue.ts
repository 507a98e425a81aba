// Drawing pictures on canvases, a few in each frame, so that none takes so long that scrolling stutters.
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

/** Draws a picture; one that is shown much smaller is made smaller first, as browsers leave its edges ragged. */
export function drawOn(canvas: HTMLCanvasElement, image: ImageData): void {
  const wide = canvas.clientWidth * window.devicePixelRatio;
  const scale = wide > 0 && image.width > 2 * wide ? wide / image.width : 1;
  canvas.width = Math.round(image.width * scale);
  canvas.height = Math.round(image.height * scale);
  // kept by the processor, so that it is painted into the page and not a layer of its own that each frame puts together
  const context = canvas.getContext("2d", { willReadFrequently: true });
  if (!context || scale === 1) return context?.putImageData(image, 0, 0);
  const whole = new OffscreenCanvas(image.width, image.height);
  whole.getContext("2d")?.putImageData(image, 0, 0);
  context.imageSmoothingQuality = "high";
  context.drawImage(whole, 0, 0, canvas.width, canvas.height);
}
