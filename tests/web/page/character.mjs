// A character of boxes as a GLB: skinned, textured, with or without motion.

import { crc32, deflateSync } from 'node:zlib';

/** Joints in a T-pose that faces +Z: name, parent, place in metres; what each has of the body goes
 * to the place in the end. */
const kJoints = [
  ['hips', -1, [0, 0.95, 0], [0, 1.1, 0]],
  ['spine', 0, [0, 1.1, 0], [0, 1.25, 0]],
  ['chest', 1, [0, 1.25, 0], [0, 1.48, 0]],
  ['neck', 2, [0, 1.48, 0], [0, 1.56, 0]],
  ['head', 3, [0, 1.56, 0], [0, 1.78, 0]],
  ...[['left', 1], ['right', -1]].flatMap(([side, x], i) => {
    const first = 5 + 8 * i;
    return [
      [`${side}Shoulder`, 2, [0.04 * x, 1.44, 0], [0.16 * x, 1.44, 0]],
      [`${side}UpperArm`, first, [0.16 * x, 1.44, 0], [0.43 * x, 1.44, 0]],
      [`${side}LowerArm`, first + 1, [0.43 * x, 1.44, 0], [0.68 * x, 1.44, 0]],
      [`${side}Hand`, first + 2, [0.68 * x, 1.44, 0], [0.84 * x, 1.44, 0]],
      [`${side}UpperLeg`, 0, [0.1 * x, 0.92, 0], [0.1 * x, 0.5, 0]],
      [`${side}LowerLeg`, first + 4, [0.1 * x, 0.5, 0], [0.1 * x, 0.09, 0]],
      [`${side}Foot`, first + 5, [0.1 * x, 0.09, 0], [0.1 * x, 0.03, 0.13]],
      [`${side}Toes`, first + 6, [0.1 * x, 0.03, 0.13], [0.1 * x, 0.03, 0.2]],
    ];
  }),
];
const kThick = 0.06;  // Metres, to each side.

function chunk(type, data) {
  const out = Buffer.alloc(12 + data.length);
  out.writeUInt32BE(data.length);
  out.write(type, 4);
  data.copy(out, 8);
  out.writeUInt32BE(crc(out.subarray(4, 8 + data.length)), 8 + data.length);
  return out;
}
function crc(bytes) {
  if (crc32) return crc32(bytes);
  let out = ~0;  // Node before 22.
  for (const byte of bytes) {
    out ^= byte;
    for (let k = 0; k < 8; ++k) out = (out >>> 1) ^ (out & 1 ? 0xedb88320 : 0);
  }
  return ~out >>> 0;
}
/** A PNG, `colours` from left to right, eight pixels each. */
function texture(colours) {
  const row = Buffer.from([0, ...colours.flatMap((colour) => Array(8).fill(colour).flat())]);
  const head = Buffer.alloc(13);
  head.writeUInt32BE(8 * colours.length, 0);
  head.writeUInt32BE(8, 4);
  head.set([8, 6], 8);
  return Buffer.concat([Buffer.from('\x89PNG\r\n\x1a\n', 'latin1'), chunk('IHDR', head),
    chunk('IDAT', deflateSync(Buffer.concat(Array(8).fill(row)))), chunk('IEND', Buffer.alloc(0))]);
}

const kCorners = [0, 1, 2, 3, 4, 5, 6, 7].map((c) => [c & 1, (c >> 1) & 1, c >> 2]);
const kFaces = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];

/** Boxes as one mesh: from, to, joint, u of the texture. */
function meshOf(boxes) {
  const positions = [], uvs = [], joints = [], weights = [], indices = [];
  for (const [from, to, joint, u] of boxes) {
    for (const face of kFaces) {
      const first = positions.length / 3;
      for (const corner of face) {
        positions.push(...kCorners[corner].map((high, k) => (high ? to : from)[k]));
        uvs.push(u, 0.5);
        joints.push(joint, 0, 0, 0);
        weights.push(1, 0, 0, 0);
      }
      indices.push(first, first + 1, first + 2, first, first + 2, first + 3);
    }
  }
  return { positions, uvs, joints, weights, indices };
}

function limb(joint, thick, u) {
  const [, , a, b] = kJoints[joint];
  const low = a.map((v, k) => Math.min(v, b[k]) - thick);
  const high = a.map((v, k) => Math.max(v, b[k]) + thick);
  if (/Foot|Toes/.test(kJoints[joint][0])) low[1] = Math.max((kThick - thick) / 3, low[1]);
  return [low, high, joint, u];
}

/**
 * The bytes. `extra`: further boxes [from, to, joint name], all in the first colour. `inside`: each
 * limb has a smaller box of the second colour in it. `motion`: null for none, else how far the left
 * upper arm is turned, radians, in one second, under a `name`; 0 holds the pose. `blend`: the texture has alpha.
 */
export function boxCharacter({ extra = [], inside = false, motion = null, blend = false,
  name = 'motion' } = {}) {
  const [u, inner] = [0.25, 0.75];
  const all = kJoints.flatMap((_, j) => {
    const outside = limb(j, kThick, u);
    if (!inside) return [outside];
    // Before the box that it is in, and after it: one of both is wrongly sorted.
    return [limb(j, kThick / 2, inner), outside, limb(j, kThick / 2, inner)];
  });
  const index = (name) => kJoints.findIndex(([joint]) => joint === name);
  all.push(...extra.map(([from, to, joint]) => [from, to, index(joint), u]));
  const mesh = meshOf(all);
  const pieces = [], views = [], accessors = [];
  let size = 0;
  const add = (bytes, target) => {
    const data = Buffer.concat([bytes, Buffer.alloc((4 - (bytes.length % 4)) % 4)]);
    views.push({ buffer: 0, byteOffset: size, byteLength: bytes.length, target });
    pieces.push(data);
    size += data.length;
    return views.length - 1;
  };
  const accessor = (array, type, width, componentType, target) => {
    const bounds = type === 'VEC3' || type === 'SCALAR' ? {
      min: Array.from({ length: width }, (_, k) => Math.min(...array.filter((_, i) => i % width === k))),
      max: Array.from({ length: width }, (_, k) => Math.max(...array.filter((_, i) => i % width === k))),
    } : {};
    return accessors.push({ bufferView: add(Buffer.from(array.buffer), target), componentType, type,
      count: array.length / width, ...bounds }) - 1;
  };
  const floats = (list, type, width, target) =>
    accessor(Float32Array.from(list), type, width, 5126, target);
  const attributes = {
    POSITION: floats(mesh.positions, 'VEC3', 3, 34962),
    TEXCOORD_0: floats(mesh.uvs, 'VEC2', 2, 34962),
    JOINTS_0: accessor(Uint8Array.from(mesh.joints), 'VEC4', 4, 5121, 34962),
    WEIGHTS_0: floats(mesh.weights, 'VEC4', 4, 34962),
  };
  const indices = accessor(Uint16Array.from(mesh.indices), 'SCALAR', 1, 5123, 34963);
  const inverse = kJoints.flatMap(([, , [x, y, z]]) =>
    [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1]);
  const skin = { joints: kJoints.map((_, j) => j),
    inverseBindMatrices: floats(inverse, 'MAT4', 16) };
  const image = add(texture([[0, 200, 0, 255], [0, 0, 255, 255]]));
  const nodes = kJoints.map(([name, parent, position], j) => {
    const children = kJoints.flatMap(([, above], child) => (above === j ? [child] : []));
    return { name, ...(children.length ? { children } : {}),
      translation: parent < 0 ? position : position.map((v, k) => v - kJoints[parent][2][k]) };
  });
  nodes.push({ name: 'body', mesh: 0, skin: 0 });
  const json = {
    asset: { version: '2.0' }, scene: 0, scenes: [{ nodes: [0, kJoints.length] }], nodes,
    meshes: [{ primitives: [{ attributes, indices, material: 0 }] }], skins: [skin],
    materials: [{ pbrMetallicRoughness: { baseColorTexture: { index: 0 } }, doubleSided: true,
      ...(blend ? { alphaMode: 'BLEND' } : {}), extensions: { KHR_materials_unlit: {} } }],
    textures: [{ source: 0 }], images: [{ bufferView: image, mimeType: 'image/png' }],
    extensionsUsed: ['KHR_materials_unlit'], bufferViews: views, accessors,
  };
  if (motion !== null) {
    const input = floats([0, 0.5, 1], 'SCALAR', 1);
    const turn = (angle) => [0, 0, Math.sin(angle / 2), Math.cos(angle / 2)];
    const output = floats([0, -motion / 2, -motion].flatMap(turn), 'VEC4', 4);
    json.animations = [{ name, samplers: [{ input, output }], channels: [
      { sampler: 0, target: { node: index('leftUpperArm'), path: 'rotation' } }] }];
  }
  json.buffers = [{ byteLength: size }];
  const text = Buffer.from(JSON.stringify(json));
  const padded = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, ' ')]);
  const head = Buffer.alloc(20);
  head.write('glTF');
  [2, 28 + padded.length + size, padded.length].forEach((v, i) => head.writeUInt32LE(v, 4 * (i + 1)));
  head.write('JSON', 16);
  const bin = Buffer.alloc(8);
  bin.writeUInt32LE(size);
  bin.write('BIN\0', 4);
  return Buffer.concat([head, padded, bin, ...pieces]);
}
