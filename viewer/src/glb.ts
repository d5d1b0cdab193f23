// What is seen as a binary glTF 2.0 file: every mesh and line of the scene, at its position in space, with its colors. Other programs read it: Blender, viewers of desktops, slides.
//
// The file is a header of 12 bytes and two chunks, JSON and numbers. Positions are in meters, y points up.

import * as THREE from "three";

const FLOAT = 5126;
const UNSIGNED = 5125;
const VERTICES = 34962;
const INDICES = 34963;
const LINES = 1;
const TRIANGLES = 4;

type Material = THREE.Material & { color?: THREE.Color; roughness?: number; metalness?: number };

/** A part of the file: numbers of the scene in the axes of the world. */
interface Part {
  name: string;
  mode: number;
  material: Material;
  positions: Float32Array;
  normals?: Float32Array;
  colors?: Float32Array;
  indices: Uint32Array;
}

/** The file: what is visible below `groups`; `up` points up in it, and `generator` names the program. */
export function glb(groups: THREE.Object3D[], up: THREE.Vector3, name: string, generator: string): Uint8Array<ArrayBuffer> {
  const found: Part[] = [];
  for (const group of groups) {
    group.updateMatrixWorld(true);
    group.traverseVisible((thing) => {
      const own = part(thing);
      if (own && own.indices.length > 0) found.push(own);
    });
  }
  return file(found, up, name, generator);
}

/** A thing of the scene, if it is a mesh or lines. */
function part(thing: THREE.Object3D): Part | undefined {
  // A thin beam also has an axis with a width in pixels: its surface is in the file already.
  if ("isLineSegments2" in thing || !(thing instanceof THREE.Mesh || thing instanceof THREE.Line)) return undefined;
  const geometry = thing.geometry as THREE.BufferGeometry;
  const isMesh = thing instanceof THREE.Mesh;
  const material = thing.material as Material;
  // Trails are lines up to the present instant.
  const count = Math.min(geometry.attributes.position.count, isMesh ? Infinity : geometry.drawRange.count);
  const isStrip = thing instanceof THREE.Line && !(thing instanceof THREE.LineSegments);
  const each = geometry.index ? Array.from(geometry.index.array) : isStrip ? strip(count) : Array.from({ length: count }, (_, k) => k);
  // Things that are drawn many times are there many times: few programs read instances.
  const matrices = instances(thing);
  const { normal, color } = geometry.attributes as Record<string, THREE.BufferAttribute | undefined>;
  const own: Part = {
    name: named(thing), mode: isMesh ? TRIANGLES : LINES, material,
    positions: new Float32Array(3 * count * matrices.length),
    normals: isMesh && normal ? new Float32Array(3 * count * matrices.length) : undefined,
    colors: material.vertexColors && color ? new Float32Array(3 * count * matrices.length) : undefined,
    indices: Uint32Array.from(matrices.flatMap((_, copy) => each.map((index) => index + copy * count))),
  };
  const vector = new THREE.Vector3();
  const turned = new THREE.Matrix3();
  matrices.forEach((matrix, copy) => {
    turned.getNormalMatrix(matrix);
    for (let vertex = 0; vertex < count; vertex++) {
      const at = 3 * (copy * count + vertex);
      vector.fromBufferAttribute(geometry.attributes.position, vertex).applyMatrix4(matrix).toArray(own.positions, at);
      if (own.normals) vector.fromBufferAttribute(normal!, vertex).applyMatrix3(turned).normalize().toArray(own.normals, at);
      if (own.colors) vector.fromBufferAttribute(color!, vertex).toArray(own.colors, at);
    }
  });
  return own;
}

/** The name of a thing or of the one that it belongs to. */
const named = (thing: THREE.Object3D): string => thing.name || (thing.parent ? named(thing.parent) : "");

/** Where a thing is drawn: once, or as often as it has instances that are not empty. */
function instances(thing: THREE.Object3D): THREE.Matrix4[] {
  if (!(thing instanceof THREE.InstancedMesh)) return [thing.matrixWorld];
  const all = Array.from({ length: thing.count }, (_, k) => {
    const matrix = new THREE.Matrix4();
    thing.getMatrixAt(k, matrix);
    return matrix.premultiply(thing.matrixWorld);
  });
  return all.filter((matrix) => matrix.determinant() !== 0);
}

/** The pieces of a line through so many points. */
const strip = (count: number): number[] => Array.from({ length: Math.max(0, 2 * count - 2) }, (_, k) => (k + 1) >> 1);

/** Numbers as glTF describes them. */
class Numbers {
  readonly views: object[] = [];
  readonly accessors: object[] = [];
  readonly pieces: (Float32Array | Uint32Array)[] = [];
  length = 0;

  /** Adds them; returns their number. All have four bytes, so that every view begins where it may. */
  add(values: Float32Array | Uint32Array, isBounded = false): number {
    const isIndex = values instanceof Uint32Array;
    this.views.push({ buffer: 0, byteOffset: this.length, byteLength: values.byteLength, target: isIndex ? INDICES : VERTICES });
    const accessor = { bufferView: this.views.length - 1, componentType: isIndex ? UNSIGNED : FLOAT, count: isIndex ? values.length : values.length / 3, type: isIndex ? "SCALAR" : "VEC3" };
    this.pieces.push(values);
    this.length += values.byteLength;
    return this.accessors.push(isBounded ? { ...accessor, ...bounds(values) } : accessor) - 1;
  }
}

/** The smallest and the largest value of each component. */
function bounds(values: ArrayLike<number>): { min: number[]; max: number[] } {
  const [min, max] = [[Infinity, Infinity, Infinity], [-Infinity, -Infinity, -Infinity]];
  for (let at = 0; at < values.length; at++) {
    min[at % 3] = Math.min(min[at % 3], values[at]);
    max[at % 3] = Math.max(max[at % 3], values[at]);
  }
  return { min, max };
}

/** A material: three.js keeps colors as glTF wants them, linear. */
function look(material: Material, isColored: boolean): object {
  const { color, opacity, roughness = 1, metalness = 0, side } = material;
  const rgb = isColored || !color ? [1, 1, 1] : color.toArray();
  return {
    pbrMetallicRoughness: { baseColorFactor: [...rgb, opacity], roughnessFactor: roughness, metallicFactor: metalness },
    ...(opacity < 1 ? { alphaMode: "BLEND" } : {}),
    doubleSided: side === THREE.DoubleSide,
  };
}

function file(parts: Part[], up: THREE.Vector3, name: string, generator: string): Uint8Array<ArrayBuffer> {
  const numbers = new Numbers();
  const kinds = [...new Set(parts.map(key))];
  const meshes = parts.map((own) => {
    const attributes: Record<string, number> = { POSITION: numbers.add(own.positions, true) };
    if (own.normals) attributes.NORMAL = numbers.add(own.normals);
    if (own.colors) attributes.COLOR_0 = numbers.add(own.colors);
    return { name: own.name, primitives: [{ attributes, indices: numbers.add(own.indices), mode: own.mode, material: kinds.indexOf(key(own)) }] };
  });
  const { x, y, z, w } = new THREE.Quaternion().setFromUnitVectors(up, new THREE.Vector3(0, 1, 0));
  const json = {
    asset: { version: "2.0", generator },
    scene: 0,
    scenes: [{ name, nodes: [0] }],
    nodes: [{ name, rotation: [x, y, z, w], ...(meshes.length > 0 ? { children: meshes.map((_, k) => k + 1) } : {}) }, ...meshes.map((mesh, k) => ({ name: mesh.name, mesh: k }))],
    ...(meshes.length > 0 ? { meshes, materials: kinds.map((kind) => JSON.parse(kind)), accessors: numbers.accessors, bufferViews: numbers.views, buffers: [{ byteLength: numbers.length }] } : {}),
  };
  return chunks(new TextEncoder().encode(JSON.stringify(json)), numbers);
}

const key = ({ material, colors }: Part): string => JSON.stringify(look(material, colors !== undefined));

/** The bytes of the file: every chunk is a multiple of four long, JSON with spaces behind it. */
function chunks(json: Uint8Array, { pieces, length }: Numbers): Uint8Array<ArrayBuffer> {
  const padded = (json.length + 3) & ~3;
  const bytes = new Uint8Array(12 + 8 + padded + (length > 0 ? 8 + length : 0)).fill(0x20, 20, 20 + padded);
  const view = new DataView(bytes.buffer);
  [0x46546c67, 2, bytes.length, padded, 0x4e4f534a].forEach((word, k) => view.setUint32(4 * k, word, true));
  bytes.set(json, 20);
  if (length === 0) return bytes;
  view.setUint32(20 + padded, length, true);
  view.setUint32(24 + padded, 0x004e4942, true);
  let at = 28 + padded;
  for (const piece of pieces) {
    bytes.set(new Uint8Array(piece.buffer, piece.byteOffset, piece.byteLength), at);
    at += piece.byteLength;
  }
  return bytes;
}
