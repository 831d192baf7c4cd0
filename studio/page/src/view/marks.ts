// Lines that are drawn into the picture: the box of the limits, the centre of mass, a distance.
import {
  BoxGeometry,
  BufferGeometry,
  EdgesGeometry,
  Group,
  LineBasicMaterial,
  LineSegments,
  Mesh,
  MeshBasicMaterial,
  SphereGeometry,
  Vector3,
} from "three";

/** A box of these sides, mm, standing on a height of the scene, m. */
export function box([width, depth, height]: [number, number, number], lowest: number): LineSegments {
  const solid = new BoxGeometry(width / 1000, height / 1000, depth / 1000);
  const lines = new LineSegments(new EdgesGeometry(solid), new LineBasicMaterial({ color: 0x1f6feb }));
  solid.dispose();
  lines.position.y = lowest + height / 2000;
  return lines;
}

/** A cross and a ball, drawn over everything. */
export function cross(at: Vector3): Group {
  const arm = 0.02;
  const ends = [new Vector3(arm, 0, 0), new Vector3(0, arm, 0), new Vector3(0, 0, arm)].flatMap((end) => [
    end.clone().negate(),
    end,
  ]);
  const lines = new LineSegments(
    new BufferGeometry().setFromPoints(ends),
    new LineBasicMaterial({ color: 0xd1344b, depthTest: false }),
  );
  const ball = new Mesh(
    new SphereGeometry(0.003, 16, 12),
    new MeshBasicMaterial({ color: 0xd1344b, depthTest: false }),
  );
  const group = new Group();
  group.add(lines, ball);
  group.renderOrder = 10;
  group.position.copy(at);
  return group;
}

/** One or two points, and the line between two. */
export function distance(points: Vector3[]): Group {
  const group = new Group();
  group.name = "distance";
  for (const point of points) {
    const ball = new Mesh(
      new SphereGeometry(0.0015, 12, 8),
      new MeshBasicMaterial({ color: 0x0b7a4b, depthTest: false }),
    );
    ball.position.copy(point);
    group.add(ball);
  }
  if (points.length === 2) {
    group.add(
      new LineSegments(
        new BufferGeometry().setFromPoints(points),
        new LineBasicMaterial({ color: 0x0b7a4b, depthTest: false }),
      ),
    );
  }
  return group;
}
