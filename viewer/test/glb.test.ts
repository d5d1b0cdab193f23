// The file of glTF that the page saves, read by the loader of three.js. A wrong file would be refused by it, lie on its side, or have things where they are not.

import assert from "node:assert/strict";
import { test } from "node:test";
import * as THREE from "three";
import { GLTFLoader, type GLTF } from "three/examples/jsm/loaders/GLTFLoader.js";
import { glb } from "../src/glb";

Object.assign(globalThis, { self: globalThis });

const read = (bytes: Uint8Array<ArrayBuffer>): Promise<GLTF> => new GLTFLoader().parseAsync(bytes.buffer, "");

/** A triangle in the plane z = 0, one corner in each color. */
function triangle(): THREE.Mesh {
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.Float32BufferAttribute([0, 0, 0, 1, 0, 0, 0, 2, 0], 3));
  geometry.setAttribute("normal", new THREE.Float32BufferAttribute([0, 0, 1, 0, 0, 1, 0, 0, 1], 3));
  geometry.setAttribute("color", new THREE.Float32BufferAttribute([1, 0, 0, 0, 1, 0, 0, 0, 1], 3));
  geometry.setIndex([0, 1, 2]);
  const mesh = new THREE.Mesh(geometry, new THREE.MeshStandardMaterial({ vertexColors: true, side: THREE.DoubleSide }));
  mesh.name = "arm";
  return mesh;
}

const Z = new THREE.Vector3(0, 0, 1);
const meshes = ({ scene }: GLTF) => {
  scene.updateMatrixWorld(true);
  const found: THREE.Mesh[] = [];
  scene.traverse((thing) => "isMesh" in thing && found.push(thing as THREE.Mesh));
  return found;
};
/** A vertex in space, rounded: numbers of the file have 24 bits. */
const corner = (mesh: THREE.Mesh, vertex: number) => mesh.getVertexPosition(vertex, new THREE.Vector3()).applyMatrix4(mesh.matrixWorld).toArray().map((part) => Math.round(1e6 * part) / 1e6 + 0);

test("a beam is a mesh with its colors, and up is y", async () => {
  const [mesh, ...others] = meshes(await read(glb([triangle()], Z, "Model", "ancf14")));
  assert.deepEqual([mesh.name, others.length], ["arm", 0]);
  assert.deepEqual([...mesh.geometry.attributes.color.array], [1, 0, 0, 0, 1, 0, 0, 0, 1]);
  // z became y, y became -z.
  assert.deepEqual([corner(mesh, 1), corner(mesh, 2)], [[1, 0, 0], [0, 0, -2]]);
});

test("things are where they are drawn, those drawn many times each time, and normals have length 1", async () => {
  const moved = triangle();
  moved.position.set(0, 0, 3);
  moved.scale.set(2, 1, 3);
  const group = new THREE.Group().add(moved);
  const copies = new THREE.InstancedMesh(moved.geometry, new THREE.MeshStandardMaterial({ color: 0xff0000 }), 3);
  copies.setMatrixAt(0, new THREE.Matrix4().makeTranslation(0, 0, 5));
  copies.setMatrixAt(1, new THREE.Matrix4().makeTranslation(0, 0, 6));
  // An empty one is not drawn.
  copies.setMatrixAt(2, new THREE.Matrix4().makeScale(0, 0, 0));
  copies.name = "springs";
  const [one, two] = meshes(await read(glb([group, copies], Z, "Model", "ancf14")));
  assert.deepEqual(corner(one, 1), [2, 3, 0]);
  assert.deepEqual([...one.geometry.attributes.normal.array].slice(0, 3), [0, 0, 1]);
  assert.deepEqual([...two.geometry.index!.array], [0, 1, 2, 3, 4, 5]);
  assert.deepEqual([corner(two, 1), corner(two, 4)], [[1, 5, 0], [1, 6, 0]]);
  assert.deepEqual((two.material as THREE.MeshStandardMaterial).color.toArray(), [1, 0, 0]);
});

test("what is hidden is not in the file; lines are, up to where they are drawn", async () => {
  const hidden = triangle();
  hidden.visible = false;
  const line = new THREE.Line(new THREE.BufferGeometry().setFromPoints([0, 1, 2, 3].map((x) => new THREE.Vector3(x, 0, 0))), new THREE.LineBasicMaterial());
  line.geometry.setDrawRange(0, 3);
  const { scene } = await read(glb([hidden, line], Z, "Model", "ancf14"));
  const lines: THREE.LineSegments[] = [];
  scene.traverse((thing) => "isLineSegments" in thing && lines.push(thing as THREE.LineSegments));
  assert.equal(lines.length, 1);
  assert.deepEqual([...lines[0].geometry.index!.array], [0, 1, 1, 2]);
});

test("a file of nothing is a file", async () => {
  assert.equal(meshes(await read(glb([], Z, "Model", "ancf14"))).length, 0);
});
