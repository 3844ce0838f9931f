// Two independent opinions of GLB and glTF files: the Khronos validator on the format, manifold-3d on
// the surface.
//
// usage: node validate.mjs [--expect-faults] FILE...
// A directory stands for the .glb and .gltf files in it.
// Prints one JSON object a line and file: numErrors, numWarnings, messages, meshes (triangles,
// manifold, volume in mm^3, genus) and the volume of all nodes in mm^3. Exit: 0 all good (with
// --expect-faults: none good), 1 not so, 77 when the npm packages are missing; with CI=true 1.
import {readdirSync, readFileSync, statSync} from 'node:fs';
import {join} from 'node:path';

let validator, NodeIO, gltf, manifold;
try {
  validator = (await import('gltf-validator')).default;
  ({NodeIO} = await import('@gltf-transform/core'));
  gltf = await import('manifold-3d/lib/gltf-io.js');
  manifold = await (await import('manifold-3d')).default();
  manifold.setup();
} catch (error) {
  console.error(`The npm packages of tests/npm are not installed: ${error.message}`);
  process.exit(process.env.CI === 'true' ? 1 : 77);
}

// Infos are no faults: the validator knows no EXT_mesh_manifold, so what only that uses looks unused.
async function validate(bytes) {
  const {issues} = await validator.validateBytes(bytes, {maxIssues: 100});
  return {
    numErrors: issues.numErrors,
    numWarnings: issues.numWarnings,
    messages: issues.messages.filter(m => m.severity < 2)
                  .map(m => `${m.code} at ${m.pointer}: ${m.message}`),
  };
}

function determinant(m) {  // of the upper left 3 x 3, column-major
  return m[0] * (m[5] * m[10] - m[9] * m[6]) - m[4] * (m[1] * m[10] - m[9] * m[2]) +
      m[8] * (m[1] * m[6] - m[5] * m[2]);
}

/// As manifold-3d's own importer reads it, but without its attempts at repair.
function examine(mesh) {
  const triangles = mesh.listPrimitives().reduce((n, p) => n + p.getIndices().getCount() / 3, 0);
  const result = {name: mesh.getName(), triangles, manifold: false, volume: 0, genus: 0};
  if (!mesh.getExtension('EXT_mesh_manifold')) return result;
  try {
    const solid = new manifold.Manifold(new manifold.Mesh(gltf.readMesh(mesh).mesh));
    result.manifold = solid.status() === 'NoError';
    result.volume = solid.volume();
    result.genus = solid.genus();
    solid.delete();
  } catch (error) {
    result.error = String(error.message ?? error);
  }
  return result;
}

async function report(path) {
  const bytes = new Uint8Array(readFileSync(path));
  const result = {file: path, ...await validate(bytes), meshes: [], volume: 0};
  const io = gltf.setupIO(new NodeIO());
  const document = path.endsWith('.glb') ?
      await io.readBinary(bytes) :
      await io.readJSON({json: JSON.parse(new TextDecoder().decode(bytes)), resources: {}});
  const examined = new Map();
  for (const mesh of document.getRoot().listMeshes()) {
    examined.set(mesh, examine(mesh));
    result.meshes.push(examined.get(mesh));
  }
  for (const node of document.getRoot().listNodes()) {
    const mesh = examined.get(node.getMesh());
    if (mesh) result.volume += mesh.volume * Math.abs(determinant(node.getWorldMatrix())) * 1e9;
  }
  result.good = result.numErrors === 0 && result.numWarnings === 0 &&
      result.meshes.every(mesh => mesh.manifold);
  return result;
}

const isModel = path => /\.gl(b|tf)$/.test(path);
const expectFaults = process.argv[2] === '--expect-faults';
const files = process.argv.slice(expectFaults ? 3 : 2).flatMap(
    path => statSync(path).isDirectory() ?
        readdirSync(path).sort().filter(isModel).map(name => join(path, name)) : [path]);
let good = files.length > 0;
for (const file of files) {
  const result = await report(file);
  console.log(JSON.stringify(result));
  good &&= result.good !== expectFaults;
}
process.exit(good ? 0 : 1);
