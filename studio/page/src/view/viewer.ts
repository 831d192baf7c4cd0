// The picture of the frame: drawn when something changes, and not otherwise. Lengths in the scene are metres, up is Y.
import {
  AnimationMixer,
  Box3,
  DirectionalLight,
  Group,
  HemisphereLight,
  Matrix4,
  PerspectiveCamera,
  Plane,
  Raycaster,
  Scene,
  Spherical,
  Vector2,
  Vector3,
  WebGLRenderer,
} from "three";
import type { Mesh } from "three";
import { OrbitControls } from "three/examples/jsm/controls/OrbitControls.js";
import type { Body, Picture } from "./bodies.ts";
import { dispose, readPicture, sizeMm } from "./bodies.ts";
import type { BodyFacts } from "./body_facts.ts";
import { isDisc } from "./body_facts.ts";
import type { ColourBy } from "./colours.ts";
import { Colours } from "./colours.ts";
import type { Standing } from "../state/standing.ts";
import * as marks from "./marks.ts";
import { StepBoxes } from "./step_boxes.ts";

export type Look = {
  colourBy: ColourBy;
  /** How far bodies are moved apart, as a share of their distance from the hub's axis. */
  explode: number;
  discs: boolean;
  /** Width, depth and height of the box of the limits, mm; none to hide it. */
  envelopeMm: [number, number, number] | null;
  /** The centre of mass in the frame's axes, mm. */
  centreMm: [number, number, number] | null;
  /** What is cut away: beyond this along an axis of the frame, mm. */
  section: { axis: "x" | "y" | "z"; atMm: number } | null;
  lit: Set<string>;
  standings: Map<string, Standing>;
  ghost: boolean;
};

/** A view: what is looked at, from where, and the share of the height that the width is, 1 at most. */
type View = { target: Vector3; way: Vector3; share: number };

/** What is shown: modules that are apart and the bed take other room than the frame. */
type Place = "frame" | "apart" | "bed";

/** A motion in the place of the frame; `steps` of an assembly, whose camera follows them, and what bounds the step that is shown. */
type Motion = { picture: Picture; mixer: AnimationMixer; seconds: number; steps: StepBoxes | null; box: Box3 };

/** What is shown is this much smaller than the picture at least when the camera is placed. */
const MARGIN = 1.06;

/** What was clicked, where, and its length, width and height in its own axes, mm. */
export type Picked = { body: Body; at: Vector3; sizeMm: [number, number, number] };

/** From the frame's axes (X right, Y front, Z up, mm) to the scene's. */
export function toScene([x, y, z]: readonly number[]): Vector3 {
  return new Vector3(-(x ?? 0) / 1000, (z ?? 0) / 1000, (y ?? 0) / 1000);
}

/** At its very end a motion would be at its beginning again. */
function lastMoment(seconds: number): number {
  return seconds - 1e-4;
}

/** The camera is no nearer and no farther than this, m, and no nearer to the axis through the poles, rad: there it would turn over. */
const NEAREST_M = 0.02;
const FARTHEST_M = 5;
const POLE = 0.02;

export class Viewer {
  readonly renderer: WebGLRenderer;
  readonly scene = new Scene();
  readonly camera = new PerspectiveCamera(35, 1, 0.005, 20);
  readonly controls: OrbitControls;
  onPick: (picked: Picked | null) => void = () => undefined;
  /** Drawings so far. */
  drawn = 0;
  #colours = new Colours();
  #plane = new Plane();
  #picture: Picture | null = null;
  #ghost: Picture | null = null;
  #motion: Motion | null = null;
  #extra = new Group();
  #marks = new Group();
  #measured = new Group();
  #look: Look | null = null;
  #asked = false;
  /** Whether a person turned, moved or zoomed since the camera was placed: then it is not placed again unasked. */
  #own = false;
  #held = false;
  #place: Place | null = null;
  /** A person's own view of the frame, while something else is shown. */
  #kept: View | null = null;
  #explode = 0;
  #latest = 0;
  #latestMotion = 0;
  /** What bounds the frame while its bodies are in their places, without the discs. */
  #atRest = new Box3();
  /** What the marks were made of. */
  #marked = "";

  constructor(readonly canvas: HTMLCanvasElement) {
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true });
    this.renderer.localClippingEnabled = true;
    this.camera.position.set(-0.25, 0.22, 0.36);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.minDistance = NEAREST_M;
    this.controls.maxDistance = FARTHEST_M;
    this.controls.addEventListener("start", () => (this.#held = true));
    this.controls.addEventListener("end", () => (this.#held = false));
    this.controls.addEventListener("change", () => {
      if (this.#held) this.#own = true;
      this.draw();
    });
    const sun = new DirectionalLight(0xffffff, 2.2);
    sun.position.set(0.6, 1, 0.4);
    this.camera.add(sun);
    this.scene.add(this.camera, new HemisphereLight(0xffffff, 0x8d99a6, 1.6), this.#extra, this.#marks, this.#measured);
    new ResizeObserver(() => this.#resize()).observe(canvas.parentElement ?? canvas);
    this.#listen();
    this.#resize();
  }

  /** Shows a frame; the camera stays where it is, unless the frame does not fit any more. */
  async show(bytes: Uint8Array<ArrayBuffer>): Promise<void> {
    const number = ++this.#latest;
    const picture = await readPicture(bytes);
    if (number !== this.#latest) return dispose(picture.root);
    if (this.#picture) this.#remove(this.#picture);
    this.#picture = picture;
    this.#atRest = this.#bounds();
    this.scene.add(picture.root);
    this.#colours.know(picture.bodies.map(({ facts }) => facts));
    this.apply(this.#look);
    this.#refit();
  }

  /** Shows another frame through this one; `null` takes it away. */
  async overlay(bytes: Uint8Array<ArrayBuffer> | null): Promise<void> {
    const picture = bytes ? await readPicture(bytes) : null;
    if (this.#ghost) this.#remove(this.#ghost);
    this.#ghost = picture;
    if (picture) this.scene.add(picture.root);
    this.apply(this.#look);
  }

  /**
   * Shows a motion in the place of the frame; gives its length, s, or `null` where another was asked for meanwhile. `null` shows the frame
   * again. `stepSeconds`: how long each step of an assembly is; `at`: where it begins.
   */
  async move(
    bytes: Uint8Array<ArrayBuffer> | null,
    { stepSeconds = null as number | null, at = 0 } = {},
  ): Promise<number | null> {
    const number = ++this.#latestMotion;
    if (this.#motion) this.#remove(this.#motion.picture);
    this.#motion = null;
    if (bytes) {
      const picture = await readPicture(bytes);
      if (number !== this.#latestMotion) {
        dispose(picture.root);
        return null;
      }
      const mixer = new AnimationMixer(picture.root);
      // A file may hold the steps one by one, too: played together they would be blended.
      const whole = picture.clips.toSorted((a, b) => b.duration - a.duration)[0];
      if (whole) mixer.clipAction(whole).play();
      const seconds = whole?.duration ?? 0;
      picture.root.traverse((object) => (object.frustumCulled = false));
      const steps = stepSeconds === null ? null : new StepBoxes(picture, mixer, stepSeconds, lastMoment(seconds));
      this.#motion = { picture, mixer, seconds, steps, box: new Box3().setFromObject(picture.root) };
      this.#colours.knowParts(picture.bodies.map(({ facts }) => facts));
      this.scene.add(picture.root);
      this.moveTo(at);
    }
    this.apply(this.#look);
    return this.#motion?.seconds ?? 0;
  }

  /** Puts the motion at a time, s. */
  moveTo(seconds: number): void {
    const motion = this.#motion;
    if (!motion) return;
    const at = Math.min(seconds, lastMoment(motion.seconds));
    const box = motion.steps?.box(motion.steps.stepAt(at)) ?? motion.box;
    motion.mixer.setTime(at);
    // The camera follows from step to step, unless the view is a person's own.
    if (box !== motion.box) {
      motion.box = box;
      if (!this.#own && this.#place === "apart") this.fit();
    }
    this.draw();
  }

  /** Objects shown in the place of the frame, such as a bed with parts; none shows the frame again. */
  replace(objects: Group | null): void {
    for (const child of [...this.#extra.children]) {
      dispose(child, { own: true });
      this.#extra.remove(child);
    }
    if (objects) this.#extra.add(objects);
    this.apply(this.#look);
  }

  apply(look: Look | null): void {
    this.#look = look;
    if (!look) return;
    const section = look.section;
    this.#colours.clipping.length = 0;
    if (section) {
      const normal = toScene([
        section.axis === "x" ? -1000 : 0,
        section.axis === "y" ? -1000 : 0,
        section.axis === "z" ? -1000 : 0,
      ]);
      this.#plane.set(normal.normalize(), section.atMm / 1000);
      this.#colours.clipping.push(this.#plane);
    }
    const replaced = this.#motion !== null || this.#extra.children.length > 0;
    for (const picture of [this.#picture, this.#ghost, this.#motion?.picture]) {
      if (!picture) continue;
      const ghost = picture === this.#ghost;
      picture.root.visible =
        picture === this.#motion?.picture ? this.#extra.children.length === 0 : !replaced && (!ghost || look.ghost);
      for (const body of picture.bodies) this.#dress(body, look, ghost, picture === this.#motion?.picture);
    }
    this.#mark(replaced ? null : look.envelopeMm, replaced ? null : look.centreMm);
    this.#arrange(look.explode);
    this.draw();
  }

  /** Points and the line between them. */
  showDistance(points: Vector3[]): void {
    dispose(this.#measured, { own: true });
    this.#measured.clear();
    if (points.length > 0) this.#measured.add(marks.distance(points));
    this.draw();
  }

  /** The camera looks at everything that is shown. */
  fit(): void {
    this.#lookAt(this.#shown());
    this.#own = false;
  }

  /** The camera goes to the bodies of these names, and keeps its direction. */
  fly(names: Set<string>): boolean {
    const box = new Box3();
    for (const { facts, mesh } of this.#picture?.bodies ?? []) {
      if (names.has(facts.name) || names.has(facts.part)) box.expandByObject(mesh);
    }
    if (box.isEmpty()) return false;
    this.#lookAt(box.expandByScalar(0.02));
    this.#own = true;
    return true;
  }

  /** A body of the picture by its name, as if it were picked at the same point. */
  again({ body, at }: Picked): Picked | null {
    const same = this.#picture?.bodies.find(({ facts }) => facts.name === body.facts.name);
    return same ? { body: same, at, sizeMm: sizeMm(same) } : null;
  }

  /** A body by its name, at its middle. */
  named(name: string): Picked | null {
    const body = this.#picture?.bodies.find(({ facts }) => facts.name === name);
    if (!body) return null;
    const at = new Box3().setFromObject(body.mesh).getCenter(new Vector3());
    return { body, at, sizeMm: sizeMm(body) };
  }

  facts(): BodyFacts[] {
    return this.#picture?.bodies.map(({ facts }) => facts) ?? [];
  }

  /** Width, depth and height of everything but the discs, mm, whether it is shown apart or not. */
  sizeMm(): [number, number, number] {
    const size = this.#atRest.getSize(new Vector3()).multiplyScalar(1000);
    return [size.x, size.z, size.y];
  }

  /** Least and greatest coordinate of everything but the discs along an axis of the frame, whole mm. */
  boundsMm(axis: "x" | "y" | "z"): [number, number] {
    const { min, max } = this.#atRest;
    const [low, high] = { x: [-max.x, -min.x] as const, y: [min.z, max.z] as const, z: [min.y, max.y] as const }[axis];
    return [Math.floor(1000 * low), Math.ceil(1000 * high)];
  }

  draw(): void {
    if (this.#asked) return;
    this.#asked = true;
    requestAnimationFrame(() => {
      this.#asked = false;
      this.#render();
    });
  }

  #render(): void {
    this.renderer.render(this.scene, this.camera);
    this.drawn += 1;
    this.canvas.dataset.drawn = String(this.drawn);
  }

  /** Marks the box of the limits and the centre of mass. */
  #mark(envelopeMm: Look["envelopeMm"], centreMm: Look["centreMm"]): void {
    const lowest = this.#atRest.min.y;
    const wanted = JSON.stringify([envelopeMm, centreMm, envelopeMm && lowest]);
    if (wanted === this.#marked) return;
    this.#marked = wanted;
    dispose(this.#marks, { own: true });
    this.#marks.clear();
    if (envelopeMm) this.#marks.add(marks.box(envelopeMm, lowest));
    if (centreMm) this.#marks.add(marks.cross(toScene(centreMm)));
  }

  #dress(body: Body, look: Look, ghost: boolean, moving: boolean): void {
    const { mesh } = body;
    const facts = moving ? this.#knownAs(body.facts) : body.facts;
    const standing = look.standings.get(facts.name) ?? look.standings.get(facts.part);
    const lit = look.lit.has(facts.part) || look.lit.has(facts.name);
    mesh.material = this.#colours.material(facts, look.colourBy, standing, lit && !ghost, ghost);
    // The step that puts the propellers on shows them.
    mesh.visible = look.discs || !isDisc(facts) || (moving && lit);
    if (!moving) mesh.position.copy(body.rest).addScaledVector(body.middle, look.explode);
  }

  /** The files of motions say less of a body than that of the frame. */
  #knownAs(facts: BodyFacts): BodyFacts {
    const bodies = this.#picture?.bodies ?? [];
    const known =
      bodies.find((body) => body.facts.name === facts.name) ??
      bodies.find((body) => facts.name.startsWith(`${body.facts.name}_`)) ??
      bodies.find((body) => facts.name.startsWith(body.facts.part));
    return known?.facts ?? facts;
  }

  /** What bounds everything but the discs. */
  #bounds(): Box3 {
    const box = new Box3();
    const loose = new Box3();
    // By the corners themselves, as boxes of turned boxes are too large; a body whose large box lies inside adds nothing.
    for (const { facts, mesh } of this.#picture?.bodies ?? []) {
      if (!isDisc(facts) && !box.containsBox(loose.setFromObject(mesh))) box.expandByObject(mesh, true);
    }
    return box;
  }

  /** What bounds everything that is shown. */
  #shown(): Box3 {
    if (this.#extra.children.length > 0) return new Box3().setFromObject(this.#extra);
    return this.#motion?.box ?? this.#bounds();
  }

  /** Places the camera where something else is shown than before, or bodies were moved apart. */
  #arrange(explode: number): void {
    if (!this.#picture) return;
    const place = this.#extra.children.length > 0 ? "bed" : this.#motion?.steps ? "apart" : "frame";
    if (place !== this.#place) {
      if (this.#place === "frame") this.#kept = this.#own ? this.#view() : null;
      this.#place = place;
      if (place === "frame" && this.#kept) {
        this.#take(this.#kept);
        this.#own = true;
      } else this.fit();
    } else if (explode !== this.#explode) this.#refit();
    this.#explode = explode;
  }

  /** Places the camera again where what is shown does not fit any more or has become small, unless the view is a person's own. */
  #refit(): void {
    const box = this.#shown();
    if (this.#own || box.isEmpty()) return;
    const share = this.#distance(box) / this.camera.position.distanceTo(this.controls.target);
    if (share > MARGIN || share < 0.7) this.fit();
  }

  /** How far the camera has to be from the middle of a box, in its direction, to see all corners. */
  #distance(box: Box3): number {
    const high = Math.tan((this.camera.fov * Math.PI) / 360);
    const middle = box.getCenter(new Vector3());
    const turn = new Matrix4().lookAt(this.camera.position, this.controls.target, this.camera.up).invert();
    let distance = 0;
    for (let corner = 0; corner < 8; corner++) {
      const at = new Vector3(
        (corner & 1 ? box.max : box.min).x,
        (corner & 2 ? box.max : box.min).y,
        (corner & 4 ? box.max : box.min).z,
      );
      at.sub(middle).applyMatrix4(turn);
      const reach = Math.max(Math.abs(at.x) / (high * this.camera.aspect), Math.abs(at.y) / high);
      distance = Math.max(distance, at.z + MARGIN * reach);
    }
    return distance;
  }

  #lookAt(box: Box3): void {
    if (box.isEmpty()) return;
    const direction = this.camera.position.clone().sub(this.controls.target).normalize();
    const distance = this.#distance(box);
    this.controls.target.copy(box.getCenter(new Vector3()));
    this.camera.position.copy(this.controls.target).addScaledVector(direction, distance);
    this.controls.update();
    this.draw();
  }

  #view(): View {
    const target = this.controls.target.clone();
    return { target, way: this.camera.position.clone().sub(target), share: Math.min(1, this.camera.aspect) };
  }

  /** Takes a view; what was beside each other in it has room in a narrower picture, too. */
  #take({ target, way, share }: View): void {
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(way, share / Math.min(1, this.camera.aspect));
    this.controls.update();
    this.draw();
  }

  #remove(picture: Picture): void {
    this.scene.remove(picture.root);
    dispose(picture.root);
  }

  #resize(): void {
    const { clientWidth, clientHeight } = this.canvas.parentElement ?? this.canvas;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(clientWidth, clientHeight, false);
    const view = this.#view();
    this.camera.aspect = clientWidth / clientHeight;
    this.camera.updateProjectionMatrix();
    if (this.#own) this.#take(view);
    else if (this.#picture) this.fit();
    this.draw();
  }

  #listen(): void {
    this.canvas.addEventListener("webglcontextrestored", () => this.draw());
    // Paper takes what was drawn in the same task.
    addEventListener("beforeprint", () => this.#render());
    let from: Vector2 | null = null;
    this.canvas.addEventListener("pointerdown", (event) => (from = new Vector2(event.clientX, event.clientY)));
    this.canvas.addEventListener("pointerup", (event) => {
      const moved = from?.distanceTo(new Vector2(event.clientX, event.clientY)) ?? Infinity;
      if (moved < 4) this.onPick(this.#under(event));
    });
    this.canvas.addEventListener("keydown", (event) => {
      // These are the browser's.
      if (event.ctrlKey || event.metaKey || event.altKey) return;
      const turns: Record<string, [number, number]> = {
        ArrowLeft: [-0.1, 0],
        ArrowRight: [0.1, 0],
        ArrowUp: [0, -0.1],
        ArrowDown: [0, 0.1],
      };
      const turn = turns[event.key];
      const zoom = { "+": 0.9, "-": 1 / 0.9 }[event.key];
      if (!turn && !zoom) return;
      event.preventDefault();
      const way = this.camera.position.clone().sub(this.controls.target);
      if (turn) {
        const from = new Spherical().setFromVector3(way);
        from.theta += turn[0];
        from.phi = Math.min(Math.PI - POLE, Math.max(POLE, from.phi + turn[1]));
        way.setFromSpherical(from);
      }
      this.camera.position.copy(this.controls.target).addScaledVector(way, zoom ?? 1);
      this.#own = true;
      this.controls.update();
      this.draw();
    });
  }

  #under(event: PointerEvent): Picked | null {
    const { left, top, width, height } = this.canvas.getBoundingClientRect();
    const at = new Vector2(((event.clientX - left) / width) * 2 - 1, 1 - ((event.clientY - top) / height) * 2);
    const ray = new Raycaster();
    ray.setFromCamera(at, this.camera);
    const meshes = this.#picture?.root.visible ? this.#picture.bodies.filter(({ mesh }) => mesh.visible) : [];
    const hits = ray.intersectObjects<Mesh>(
      meshes.map(({ mesh }) => mesh),
      false,
    );
    const kept = hits.find(({ point }) => !this.#look?.section || this.#plane.distanceToPoint(point) >= 0);
    const body = meshes.find(({ mesh }) => mesh === kept?.object);
    return kept && body ? { body, at: kept.point, sizeMm: sizeMm(body) } : null;
  }
}
