// node manifold_boolean.mjs union|intersection|difference once|each OUT.off IN.off...: as cgal_boolean, by manifold-3d.
//
// `each` makes one operation after the other, and asks for the box and the volume of every result.
// Prints one JSON line: the CPU seconds from arrays to arrays, reading and writing of files left out.
// A few small operations come first, so that what node compiles is not counted. The package's meshes
// are float32: so are the numbers that it is given, and those that it gives.
// Exit: 0 good, 1 an error, 77 when the npm packages are missing.
import {readFileSync, writeFileSync} from 'node:fs';

let kernel;
try {
  kernel = await (await import('manifold-3d')).default();
  kernel.setup();
} catch (error) {
  console.error(`The npm packages of tests/npm are not installed: ${error.message}`);
  process.exit(77);
}
const {Manifold, Mesh} = kernel;

function read(path) {  // triangles only, as csgbench writes them
  const words = readFileSync(path, 'utf8').split(/\s+/);
  const points = Number(words[1]), faces = Number(words[2]);
  const vertProperties = new Float32Array(3 * points), triVerts = new Uint32Array(3 * faces);
  for (let i = 0; i < 3 * points; ++i) vertProperties[i] = Number(words[4 + i]);
  for (let f = 0, w = 4 + 3 * points; f < faces; ++f, w += 4) {
    for (let k = 0; k < 3; ++k) triVerts[3 * f + k] = Number(words[w + 1 + k]);
  }
  return {numProp: 3, vertProperties, triVerts};
}

function write(path, mesh) {
  const lines = ['OFF', `${mesh.numVert} ${mesh.numTri} 0`];
  for (let v = 0; v < mesh.numVert; ++v) lines.push(Array.from(mesh.position(v)).join(' '));
  for (let t = 0; t < mesh.numTri; ++t) lines.push(`3 ${Array.from(mesh.verts(t)).join(' ')}`);
  writeFileSync(path, lines.join('\n') + '\n');
}

function combine(solids, op, asking) {
  const many = Manifold[op];
  if (asking === 'once') return many(solids);
  return solids.reduce((sum, tool) => {
    const result = many([sum, tool]);
    if (!(result.volume() > 0 && result.boundingBox().max[0] > 0)) throw Error('no volume');
    return result;
  });
}

const [op, asking, out, ...inputs] = process.argv.slice(2);
if (!/^(union|intersection|difference)$/.test(op) || !/^(once|each)$/.test(asking) || inputs.length === 0) {
  console.error('usage: manifold_boolean.mjs union|intersection|difference once|each OUT.off IN.off...');
  process.exit(2);
}
const meshes = inputs.map(read);
for (let i = 1; i <= 5; ++i) {
  combine([Manifold.sphere(1, 128), Manifold.sphere(1, 128).translate(i / 8, 0, 0)], op, asking)
      .getMesh();
}
const start = process.cpuUsage();
const result = combine(meshes.map(mesh => new Manifold(new Mesh(mesh))), op, asking).getMesh();
const {user, system} = process.cpuUsage(start);
write(out, result);
console.log(JSON.stringify({cpu_s: (user + system) / 1e6, n_out_tris: result.numTri}));
