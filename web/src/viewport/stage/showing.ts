// Shows a stage in an element of the page: hands it size and frames, and draws when it asks for it.
import type { WebGLRenderer } from "three";
import { follow } from "./following";
import type { Stage } from "./stage";

/** Shows it until the returned function is called. */
export function show(stage: Stage, gl: WebGLRenderer, holder: HTMLElement): () => void {
  let frame = 0;
  const draw = (): void => {
    frame = 0;
    if (stage.width > 0 && stage.height > 0) stage.draw(gl, performance.now() / 1000);
  };
  stage.invalidate = () => {
    frame ||= requestAnimationFrame(draw);
  };
  const resize = (): void => {
    stage.resize(holder.clientWidth, holder.clientHeight, Math.min(2, Math.max(1, window.devicePixelRatio)));
    // at once: the browser would stretch what is there
    cancelAnimationFrame(frame);
    draw();
  };
  const sizes = new ResizeObserver(resize);
  holder.append(gl.domElement);
  sizes.observe(holder);
  const stop = follow(stage);
  return () => {
    stop();
    sizes.disconnect();
    cancelAnimationFrame(frame);
    stage.invalidate = () => undefined;
    stage.dispose();
    gl.domElement.remove();
  };
}
