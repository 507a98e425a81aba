// When the page has shown its first asset, so that what is wanted less can wait for it.
import { useScenes } from "../store/scenes";

const LATEST = 3000; // [ms] where nothing is shown at all

let first: Promise<void> | undefined;

export function firstPicture(): Promise<void> {
  return (first ??= new Promise((done) => {
    const over = (): void => {
      stop();
      clearTimeout(timer);
      // it is drawn in the next frame
      requestAnimationFrame(() => setTimeout(done));
    };
    const timer = setTimeout(over, LATEST);
    const stop = useScenes.subscribe(({ scene, problem }) => (scene ?? problem) && over());
    if (useScenes.getState().scene) over();
  }));
}
