// Ambient occlusion: corners and gaps between hulls get less light. Reckoned for each pixel from depths and normals
// (McGuire, Mara and Luebke, "Scalable Ambient Obscurance", 2012), and kept as long as the picture is the same.
import { type Camera, DepthTexture, Matrix4, Mesh, MultiplyBlending, NearestFilter, OrthographicCamera, PlaneGeometry, Scene, ShaderMaterial, Vector2, type WebGLRenderer, WebGLRenderTarget } from "three";
import type { HullSet } from "./hullSet";
import { PLACE_VERTEX } from "./hullShader";
import { COVER_VERTEX, drawInto, fill } from "./passes";

/** How far light is kept away, of half the diagonal of the asset. */
const REACH = 0.16;

const NORMAL_VERTEX = /* glsl */ `
  ${PLACE_VERTEX}
  flat out vec3 up;
  void main() {
    up = normalize(mat3(modelViewMatrix) * normal);
    gl_Position = projected(texelFetch(states, place(), 0));
  }
`;

const NORMAL_FRAGMENT = /* glsl */ `
  precision highp float;
  flat in vec3 up;
  void main() {
    gl_FragColor = vec4(0.5 + 0.5 * up, 1.0);
  }
`;

const POINT = /* glsl */ `
  precision highp float;
  in vec2 spot;
  uniform sampler2D depths;
  uniform sampler2D normals;
  uniform mat4 back;
  uniform vec2 size;
  vec3 pointAt(vec2 uv, float depth) {
    vec4 at = back * vec4(2.0 * vec3(uv, depth) - 1.0, 1.0);
    return at.xyz / at.w;
  }
`;

const SAMPLES = 14;

const FRAGMENT = /* glsl */ `
  ${POINT}
  uniform float reach;
  uniform bool parallel;
  uniform float scale; // heights of the picture for a metre at a distance of one, or anywhere in parallel projection
  void main() {
    float depth = texture(depths, spot).r;
    if (depth == 1.0) { gl_FragColor = vec4(1.0); return; }
    vec3 here = pointAt(spot, depth);
    vec3 up = normalize(2.0 * texture(normals, spot).xyz - 1.0);
    float disk = scale * reach / (parallel ? 1.0 : -here.z);
    disk = clamp(disk, 3.0 / size.y, 0.16);
    ivec2 cell = ivec2(gl_FragCoord.xy) & 3;
    float turn = float((7 * (cell.x + 4 * cell.y)) & 15) * ${((2 * Math.PI) / 16).toFixed(6)};
    float sum = 0.0;
    for (int k = 0; k < ${SAMPLES}; k++) {
      float along = (float(k) + 0.5) / ${SAMPLES}.0;
      float angle = along * 43.98230 + turn;
      vec2 there = spot + disk * along * vec2(cos(angle) * size.y / size.x, sin(angle));
      vec3 away = pointAt(there, texture(depths, there).r) - here;
      float far = dot(away, away);
      float open = max(reach * reach - far, 0.0);
      sum += open * open * open * max((dot(away, up) - 0.02 * reach) / (far + 0.02 * reach * reach), 0.0);
    }
    float r6 = reach * reach * reach * reach * reach * reach;
    gl_FragColor = vec4(vec3(max(0.0, 1.0 - sum * reach * 2.4 / (r6 * ${SAMPLES}.0))), 1.0);
  }
`;

// the mean of four by four pixels of one surface: their turns are all different
const BLUR_FRAGMENT = /* glsl */ `
  ${POINT}
  uniform sampler2D raw;
  uniform float reach;
  void main() {
    float depth = texture(depths, spot).r;
    if (depth == 1.0) { gl_FragColor = vec4(1.0); return; }
    vec3 here = pointAt(spot, depth);
    vec3 up = 2.0 * texture(normals, spot).xyz - 1.0;
    vec2 sum = vec2(0.0);
    for (int k = 0; k < 16; k++) {
      vec2 there = spot + (vec2(k & 3, k >> 2) - 1.0) / size;
      vec3 away = pointAt(there, texture(depths, there).r) - here;
      vec3 other = 2.0 * texture(normals, there).xyz - 1.0;
      float same = step(abs(dot(away, up)), 0.15 * reach) * step(0.8, dot(up, other));
      sum += same * vec2(texture(raw, there).r, 1.0);
    }
    gl_FragColor = vec4(vec3(sum.y > 0.0 ? sum.x / sum.y : 1.0), 1.0);
  }
`;

const STRENGTH = 0.62;

const COMPOSE_FRAGMENT = /* glsl */ `
  precision highp float;
  in vec2 spot;
  uniform sampler2D open;
  void main() {
    gl_FragColor = vec4(vec3(mix(1.0, texture(open, spot).r, ${STRENGTH})), 1.0);
  }
`;

function pass(fragmentShader: string, names: readonly string[], blends = false): ShaderMaterial {
  const uniforms = Object.fromEntries(names.map((name) => [name, { value: null as unknown }]));
  const mixed = blends ? { blending: MultiplyBlending, premultipliedAlpha: true, transparent: true } : {};
  return new ShaderMaterial({ vertexShader: COVER_VERTEX, fragmentShader, uniforms, depthTest: false, depthWrite: false, ...mixed });
}

const SHARED = ["depths", "normals", "back", "size", "reach"] as const;
const occlude = pass(FRAGMENT, [...SHARED, "scale", "parallel"]);
const blur = pass(BLUR_FRAGMENT, [...SHARED, "raw"]);

function put(material: ShaderMaterial, values: Readonly<Record<string, unknown>>): void {
  for (const [name, value] of Object.entries(values)) {
    const uniform = material.uniforms[name];
    if (uniform) uniform.value = value;
  }
}

/** What occlusion needs to know: the size of a pane and of the asset [px, m], how far hulls are apart, which are in sight. */
interface Look {
  readonly width: number;
  readonly height: number;
  readonly radius: number;
  readonly explode: number;
}

export class AmbientOcclusion {
  /** Darkens what is drawn so far. */
  readonly object: Mesh;
  private readonly compose = pass(COMPOSE_FRAGMENT, ["open"], true);
  private readonly hulls = new Scene();
  private targets: { seen: WebGLRenderTarget; raw: WebGLRenderTarget; soft: WebGLRenderTarget } | null = null;
  private drawn = "";

  constructor(private readonly set: HullSet) {
    this.object = new Mesh(new PlaneGeometry(2, 2), this.compose);
    this.object.frustumCulled = false;
    this.object.renderOrder = -1;
    this.object.visible = false;
  }

  /** Shows it where it is there for the picture, or may be reckoned now; not where it is of another picture. */
  update(gl: WebGLRenderer, camera: Camera, look: Look, mayDraw: boolean): void {
    const { width, height, explode } = look;
    const key = [camera.matrixWorld.elements, camera.projectionMatrix.elements, width, height, explode, this.set.visible.map(Number).join("")].join();
    if (key !== this.drawn && mayDraw) {
      this.drawn = key;
      this.draw(gl, camera, look);
    }
    this.object.visible = key === this.drawn;
  }

  hide(): void {
    this.object.visible = false;
  }

  dispose(): void {
    this.object.geometry.dispose();
    this.forget();
  }

  private draw(gl: WebGLRenderer, camera: Camera, { width, height, radius }: Look): void {
    const { seen, raw, soft } = this.targetsOf(Math.max(1, Math.round(width)), Math.max(1, Math.round(height)));
    if (!this.hulls.children.length) this.hulls.add(this.set.facesWith(NORMAL_VERTEX, NORMAL_FRAGMENT));
    drawInto(gl, seen, () => gl.render(this.hulls, camera));
    const back = new Matrix4().copy(camera.projectionMatrix).invert();
    const shared = { depths: seen.depthTexture, normals: seen.texture, back, size: new Vector2(seen.width, seen.height), reach: REACH * radius };
    put(occlude, { ...shared, scale: (camera.projectionMatrix.elements[5] ?? 1) / 2, parallel: camera instanceof OrthographicCamera });
    fill(gl, raw, occlude);
    put(blur, { ...shared, raw: raw.texture });
    fill(gl, soft, blur);
    put(this.compose, { open: soft.texture });
  }

  private targetsOf(width: number, height: number): NonNullable<AmbientOcclusion["targets"]> {
    if (this.targets?.raw.width === width && this.targets.raw.height === height) return this.targets;
    this.forget();
    const near = { minFilter: NearestFilter, magFilter: NearestFilter } as const;
    const seen = new WebGLRenderTarget(width, height, { ...near, depthTexture: new DepthTexture(width, height) });
    const raw = new WebGLRenderTarget(width, height, { ...near, depthBuffer: false });
    return (this.targets = { seen, raw, soft: new WebGLRenderTarget(width, height, { depthBuffer: false }) });
  }

  private forget(): void {
    if (this.targets) for (const target of Object.values(this.targets)) target.dispose();
    this.targets = null;
  }
}
