// node make_avatar.mjs FILE.vrm: makes the avatar of this sample, a doll with a large head and a face
// that shows moods, as a VRM 1.0 file. All of it is drawn here; it has no author to ask.
import { writeFile } from 'node:fs/promises';

// Joints in the T-pose, metres, +Y up, facing +Z, the left side at +X.
const joints = [
  ['hips', null, [0, 0.5, 0]], ['spine', 'hips', [0, 0.57, 0]], ['chest', 'spine', [0, 0.66, 0]],
  ['neck', 'chest', [0, 0.8, -0.005]], ['head', 'neck', [0, 0.85, 0]],
];
for (const [side, x] of [['left', 1], ['right', -1]]) {
  joints.push(
    [`${side}Shoulder`, 'chest', [x * 0.035, 0.77, 0]],
    [`${side}UpperArm`, `${side}Shoulder`, [x * 0.115, 0.765, 0]],
    [`${side}LowerArm`, `${side}UpperArm`, [x * 0.265, 0.765, 0]],
    [`${side}Hand`, `${side}LowerArm`, [x * 0.4, 0.765, 0]],
    [`${side}UpperLeg`, 'hips', [x * 0.07, 0.47, 0]],
    [`${side}LowerLeg`, `${side}UpperLeg`, [x * 0.07, 0.26, 0.005]],
    [`${side}Foot`, `${side}LowerLeg`, [x * 0.07, 0.06, -0.01]],
    [`${side}Toes`, `${side}Foot`, [x * 0.07, 0.02, 0.06]]);
}
const at = new Map(joints.map(([name, , position]) => [name, position]));
const indexOf = (name) => joints.findIndex(([own]) => own === name);

const add = (a, b) => a.map((v, i) => v + b[i]);
const scale = (a, s) => a.map((v) => v * s);
const dot = (a, b) => a.reduce((sum, v, i) => sum + v * b[i], 0);
const cross = ([a, b, c], [d, e, f]) => [b * f - c * e, c * d - a * f, a * e - b * d];
const unit = (a) => scale(a, 1 / Math.hypot(...a));

// ---- Shapes: vertices with a normal and the joint that they follow ----

/** A surface from a grid of points: `point(u, v)` for u, v in 0 to 1. */
function surface(columns, rows, point) {
  const positions = [], triangles = [];
  for (let r = 0; r <= rows; ++r) {
    for (let c = 0; c <= columns; ++c) positions.push(point(c / columns, r / rows));
  }
  for (let r = 0; r < rows; ++r) {
    for (let c = 0; c < columns; ++c) {
      const a = r * (columns + 1) + c, b = a + columns + 1;
      triangles.push([a, b, a + 1], [a + 1, b, b + 1]);
    }
  }
  return { positions, triangles };
}

/** A ball that is wider, higher or deeper; `turn` bends a point of it. */
const ball = (centre, [x, y, z], columns = 16, rows = 10) => surface(columns, rows, (u, v) => {
  const around = 2 * Math.PI * u, down = Math.PI * v;
  return add(centre, [x * Math.sin(down) * Math.sin(around), y * Math.cos(down),
    z * Math.sin(down) * Math.cos(around)]);
});

/** A rounded limb from `a` to `b`. */
function limb(a, b, ra, rb, columns = 12) {
  const axis = add(b, scale(a, -1)), length = Math.hypot(...axis), y = unit(axis);
  const x = unit(cross(Math.abs(y[1]) < 0.9 ? [0, 1, 0] : [0, 0, 1], y)), z = cross(x, y);
  const cap = 3;
  return surface(columns, 2 * cap + 2, (u, v) => {
    const row = Math.round(v * (2 * cap + 2)), around = -2 * Math.PI * u;
    const lower = row <= cap;
    const angle = lower ? (Math.PI / 2) * (row / cap - 1) : (Math.PI / 2) * ((row - cap - 2) / cap);
    const middle = row === cap + 1;
    const along = middle ? length / 2 : (lower ? 0 : length) + Math.sin(angle) * (lower ? ra : rb);
    const r = middle ? (ra + rb) / 2 : Math.cos(angle) * (lower ? ra : rb);
    return add(add(a, scale(y, along)),
      add(scale(x, r * Math.cos(around)), scale(z, r * Math.sin(around))));
  });
}

/** Normals that point outwards, from the triangles around each vertex. */
function normalsOf({ positions, triangles }) {
  const out = positions.map(() => [0, 0, 0]);
  const same = new Map();  // The first vertex at a place: seams are smooth.
  const first = positions.map((p) => {
    const key = p.map((v) => Math.round(1e5 * v) || 0).join();
    if (!same.has(key)) same.set(key, same.size);
    return same.get(key);
  });
  for (const [a, b, c] of triangles) {
    const n = cross(add(positions[b], scale(positions[a], -1)), add(positions[c], scale(positions[a], -1)));
    for (const i of [a, b, c]) out[first[i]] = add(out[first[i]], n);
  }
  return positions.map((_, i) => (Math.hypot(...out[first[i]]) > 1e-12
    ? unit(out[first[i]]) : [0, 0, 1]));
}

// ---- The body: parts by material ----

const colours = { skin: '#f2c9a8', shirt: '#3f8fd0', trousers: '#33415c', shoes: '#a8432b', hair: '#5b3a29',
  white: '#ffffff', dark: '#2b2024', mouth: '#8f2f37' };
const parts = [];  // { material, shape, joint of each vertex, face of each vertex or none }
const put = (material, shape, joint, morphs) => parts.push({ material, shape, joint, morphs });

put('trousers', ball([0, 0.5, 0], [0.105, 0.075, 0.085]), 'hips');
put('shirt', limb([0, 0.56, 0], [0, 0.6, 0], 0.098, 0.1, 20), 'spine');
put('shirt', ball([0, 0.69, 0], [0.12, 0.105, 0.09]), 'chest');
put('skin', limb(at.get('neck'), at.get('head'), 0.035, 0.035), 'neck');
for (const side of ['left', 'right']) {
  const joint = (name) => at.get(side + name);
  put('shirt', limb(joint('UpperArm'), joint('LowerArm'), 0.044, 0.038), `${side}UpperArm`);
  put('skin', limb(joint('LowerArm'), joint('Hand'), 0.034, 0.028), `${side}LowerArm`);
  const out = Math.sign(joint('Hand')[0]);
  put('skin', ball(add(joint('Hand'), [out * 0.045, -0.002, 0.004]), [0.05, 0.026, 0.036]), `${side}Hand`);
  put('skin', limb(add(joint('Hand'), [out * 0.02, 0, 0.025]), add(joint('Hand'), [out * 0.045, 0, 0.05]), 0.013, 0.011),
    `${side}Hand`);
  put('trousers', limb(joint('UpperLeg'), joint('LowerLeg'), 0.064, 0.05), `${side}UpperLeg`);
  put('trousers', limb(joint('LowerLeg'), add(joint('Foot'), [0, 0.02, 0]), 0.049, 0.044), `${side}LowerLeg`);
  put('shoes', ball(add(joint('Foot'), [0, -0.018, 0.025]), [0.046, 0.042, 0.075]), `${side}Foot`);
  put('shoes', ball(add(joint('Toes'), [0, 0.012, 0.015]), [0.044, 0.032, 0.045]), `${side}Toes`);
}
const head = [0, 1.02, 0.005], size = [0.165, 0.16, 0.15];
put('skin', ball(head, size, 32, 22), 'head');
for (const x of [1, -1]) put('skin', ball(add(head, [x * 0.163, -0.01, 0]), [0.025, 0.035, 0.025]), 'head');
put('skin', ball(add(head, [0, -0.015, 0.152]), [0.016, 0.014, 0.016]), 'head');
// Hair: a cap that is open in front, and a tuft.
put('hair', surface(32, 12, (u, v) => {
  const around = 2 * Math.PI * u, front = Math.max(0, Math.cos(around));
  const down = v * (1.75 - 0.95 * front ** 0.6);
  return add(head, [1.07 * size[0] * Math.sin(down) * Math.sin(around), 1.08 * size[1] * Math.cos(down),
    1.07 * size[2] * Math.sin(down) * Math.cos(around)]);
}), 'head');
put('hair', limb(add(head, [0.01, 0.16, 0.02]), add(head, [0.05, 0.2, 0.05]), 0.03, 0.006), 'head');

// ---- The face: each shape as a function of how it looks, so that moods are differences ----

/** A point of the head's surface, a little in front of it. */
function onFace(x, y, lift) {
  const [a, b, c] = size;
  const z = c * Math.sqrt(Math.max(0.05, 1 - (x / a) ** 2 - (y / b) ** 2));
  return add(head, [x, y, z + lift]);
}
/** A ribbon along a curve of the face. */
const ribbon = (curve, thick, lift) => surface(12, 1, (u, v) => {
  const [x, y, half = thick] = curve(2 * u - 1);
  return onFace(x, y + (v < 0.5 ? half : -half), lift);
});
const looks = {
  neutral: {}, happy: { smile: 1, eye: 0.75, brow: 0.4 }, sad: { smile: -1, inner: 1, eye: 0.8 },
  angry: { smile: -0.7, inner: -1.2, eye: 0.85 }, surprised: { open: 1, brow: 1, eye: 1.25 },
  relaxed: { smile: 0.5, eye: 0.45, brow: 0.2 }, blink: { eye: 0.06 }, aa: { open: 0.7 },
};
const eye = (x, width) => ({ eye: open = 1 }) =>
  surface(16, 4, (u, v) => onFace(x + width * 0.026 * v * Math.sin(2 * Math.PI * u),
    0.005 + width * 0.036 * open * v * -Math.cos(2 * Math.PI * u), 0.002 + 0.002 * (2 - width)));
const brow = (x) => ({ inner = 0, brow: up = 0 }) => ribbon((t) => [x + 0.032 * t,
  0.062 + 0.02 * up + 0.006 * (1 - t * t) - Math.sign(x) * t * 0.014 * inner], 0.005, 0.004);
const mouth = ({ smile = 0.35, open = 0 }) => ribbon((t) => [0.04 * t * (1 - 0.35 * open),
  -0.07 + 0.018 * smile * (t * t - 0.5), 0.0035 + 0.026 * open * Math.sqrt(Math.max(0, 1 - t * t))], 0, 0.003);
for (const x of [-0.058, 0.058]) {
  put('white', eye(x, 1), 'head', true);
  put('dark', eye(x, 0.62), 'head', true);
  put('hair', brow(x), 'head', true);
}
put('mouth', mouth, 'head', true);

// ---- The file ----

const buffers = [];
let offset = 0;
const json = { asset: { version: '2.0', generator: 'make_avatar.mjs' }, scene: 0, scenes: [{ nodes: [] }],
  nodes: [], meshes: [], materials: [], accessors: [], bufferViews: [], skins: [], buffers: [],
  extensionsUsed: ['VRMC_vrm'], extensions: {} };

function accessor(type, componentType, values, count, bounds, normalized) {
  const bytes = Buffer.from(values.buffer, values.byteOffset, values.byteLength);
  const padded = Buffer.concat([bytes, Buffer.alloc(-bytes.length & 3)]);
  json.bufferViews.push({ buffer: 0, byteOffset: offset, byteLength: bytes.length });
  json.accessors.push({ bufferView: json.bufferViews.length - 1, componentType, count, type,
    ...(normalized && { normalized }),
    ...(bounds && { min: bounds[0], max: bounds[1] }) });
  buffers.push(padded);
  offset += padded.length;
  return json.accessors.length - 1;
}
function vectors(list) {
  const bounds = [Math.min, Math.max].map((pick) => [0, 1, 2].map((i) =>
    Math.fround(list.reduce((best, v) => pick(best, Math.fround(v[i])), list[0][i]))));
  return accessor('VEC3', 5126, Float32Array.from(list.flat()), list.length, bounds);
}

const materials = Object.keys(colours);
for (const name of materials) {
  const linear = [1, 3, 5].map((i) => (parseInt(colours[name].slice(i, i + 2), 16) / 255) ** 2.2);
  json.materials.push({ name, doubleSided: true, pbrMetallicRoughness: {
    baseColorFactor: [...linear, 1], metallicFactor: 0, roughnessFactor: 0.85 } });
}

/** One mesh of parts, a primitive for each material, with the face's looks as morph targets. */
function makeMesh(name, own, targets) {
  const primitives = [];
  for (const material of materials) {
    const mine = own.filter((part) => part.material === material);
    if (!mine.length) continue;
    const shapesOf = (look) => mine.map(({ shape }) => (typeof shape === 'function' ? shape(look) : shape));
    const base = shapesOf(looks.neutral);
    const positions = base.flatMap(({ positions: p }) => p);
    let begin = 0;
    const triangles = base.flatMap(({ positions: p, triangles: t }) => {
      const moved = t.map((corner) => corner.map((i) => i + begin));
      begin += p.length;
      return moved;
    });
    const followed = mine.flatMap(({ joint }, i) => base[i].positions.map(() => indexOf(joint)));
    const count = positions.length;
    const primitive = { material: materials.indexOf(material), attributes: {
      POSITION: vectors(positions), NORMAL: vectors(base.flatMap(normalsOf)),
      JOINTS_0: accessor('VEC4', 5121, Uint8Array.from(followed.flatMap((j) => [j, 0, 0, 0])), count),
      WEIGHTS_0: accessor('VEC4', 5121, Uint8Array.from(followed.flatMap(() => [255, 0, 0, 0])), count, undefined, true),
    }, indices: accessor('SCALAR', 5123, Uint16Array.from(triangles.flat()), 3 * triangles.length) };
    if (targets.length) {
      primitive.targets = targets.map((look) => ({ POSITION: vectors(
        shapesOf(looks[look]).flatMap(({ positions: p }) => p).map((p, i) => add(p, scale(positions[i], -1)))) }));
    }
    primitives.push(primitive);
  }
  json.meshes.push({ name, primitives, ...(targets.length && { weights: targets.map(() => 0),
    extras: { targetNames: targets } }) });
  return json.meshes.length - 1;
}

const nodeOf = (name) => indexOf(name);
joints.forEach(([name, parent, position], i) => {
  const children = joints.flatMap(([, above], k) => (above === name ? [k] : []));
  const above = parent ? at.get(parent) : [0, 0, 0];
  json.nodes.push({ name, translation: add(position, scale(above, -1)),
    ...(children.length && { children }) });
  if (!parent) json.scenes[0].nodes.push(i);
});
json.skins.push({ joints: joints.map((_, i) => i), inverseBindMatrices: accessor('MAT4', 5126,
  Float32Array.from(joints.flatMap(([, , [x, y, z]]) => [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, -x, -y, -z, 1])),
  joints.length) });
const moods = Object.keys(looks).filter((look) => look !== 'neutral');
for (const [name, own, targets] of [['Body', parts.filter(({ morphs }) => !morphs), []],
  ['Face', parts.filter(({ morphs }) => morphs), moods]]) {
  json.nodes.push({ name, mesh: makeMesh(name, own, targets), skin: 0 });
  json.scenes[0].nodes.push(json.nodes.length - 1);
}
json.extensions.VRMC_vrm = {
  specVersion: '1.0',
  meta: { name: 'Doll', version: '1', authors: ['The Panache authors'],
    licenseUrl: 'https://vrm.dev/licenses/1.0/', avatarPermission: 'everyone',
    commercialUsage: 'corporation', modification: 'allowModificationRedistribution',
    allowRedistribution: true, creditNotation: 'unnecessary' },
  humanoid: { humanBones: Object.fromEntries(joints.map(([name]) => [name, { node: nodeOf(name) }])) },
  expressions: { preset: Object.fromEntries(moods.map((look, index) =>
    [look, { morphTargetBinds: [{ node: json.nodes.length - 1, index, weight: 1 }] }])) },
};

const data = Buffer.concat(buffers);
json.buffers.push({ byteLength: data.length });
let text = Buffer.from(JSON.stringify(json));
text = Buffer.concat([text, Buffer.alloc(-text.length & 3, ' ')]);
const chunk = (kind, bytes) => {
  const begin = Buffer.alloc(8);
  begin.writeUInt32LE(bytes.length, 0);
  begin.write(kind, 4, 'latin1');
  return Buffer.concat([begin, bytes]);
};
const chunks = Buffer.concat([chunk('JSON', text), chunk('BIN\0', data)]);
const begin = Buffer.alloc(12);
begin.write('glTF', 0, 'latin1');
begin.writeUInt32LE(2, 4);
begin.writeUInt32LE(12 + chunks.length, 8);
await writeFile(process.argv[2], Buffer.concat([begin, chunks]));
