// The two three.js cameras, both placed by one pose, so that switching keeps what is seen.
import { Matrix4, OrthographicCamera, PerspectiveCamera, Quaternion, Vector3 } from "three";
import { axesOf, distanceOf, FIELD, plus, type Pose } from "./pose";

export type Projection = "perspective" | "orthographic";

export class Cameras {
  private readonly perspective = new PerspectiveCamera((FIELD * 180) / Math.PI);
  private readonly orthographic = new OrthographicCamera();

  /** The camera at a pose; reach: how far from the target anything is that is to be seen. */
  placed(pose: Pose, projection: Projection, aspect: number, reach: number): PerspectiveCamera | OrthographicCamera {
    const camera = projection === "perspective" ? this.perspective : this.orthographic;
    const { right, up, eye } = axesOf(pose);
    const distance = projection === "perspective" ? distanceOf(pose) : reach + pose.height;
    camera.position.set(...plus(pose.target, eye, distance));
    const basis = new Matrix4().makeBasis(new Vector3(...right), new Vector3(...up), new Vector3(...eye));
    camera.quaternion.copy(new Quaternion().setFromRotationMatrix(basis));
    camera.far = distance + reach;
    camera.near = Math.max(distance - reach, projection === "perspective" ? distance * 0.02 : 0);
    if (camera instanceof PerspectiveCamera) camera.aspect = aspect;
    else this.frame(pose.height, aspect);
    camera.updateProjectionMatrix();
    camera.updateMatrixWorld();
    return camera;
  }

  private frame(height: number, aspect: number): void {
    const camera = this.orthographic;
    [camera.top, camera.bottom] = [height / 2, -height / 2];
    [camera.right, camera.left] = [(height / 2) * aspect, (-height / 2) * aspect];
  }
}
