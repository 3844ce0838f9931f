// What others read in written files: the loaders of three.js, and dxf-parser.
//
// usage: node readers.mjs FILE...
// Prints one JSON object a line and file. Of a mesh: parts, each with name, volume (in the file's units)
// and the area of each colour ("#rrggbb" or "#rrggbbaa"). Of a drawing: parts with name, area and
// colour. Exit: 0 good, 1 an error, 77 when the npm packages are missing; with CI=true 1.
import {existsSync, readFileSync} from 'node:fs';
import {dirname, extname} from 'node:path';

let THREE, loaders, DOMParser, DxfParser;
try {
  THREE = await import('three');
  const from = name => import(`three/examples/jsm/loaders/${name}.js`);
  loaders = {
    ...await from('STLLoader'), ...await from('PLYLoader'), ...await from('OBJLoader'),
    ...await from('MTLLoader'), ...await from('GLTFLoader'), ...await from('3MFLoader'),
    ...await from('SVGLoader'),
  };
  ({DOMParser} = await import('@xmldom/xmldom'));
  DxfParser = (await import('dxf-parser')).default;
} catch (error) {
  console.error(`The npm packages of tests/npm are not installed: ${error.message}`);
  process.exit(process.env.CI === 'true' ? 1 : 77);
}

// What loaders find in a browser. Their selectors are names of elements, one below the other.
globalThis.DOMParser = DOMParser;
globalThis.ProgressEvent ??= class {};
globalThis.self ??= globalThis;
const document = new DOMParser().parseFromString('<a/>', 'text/xml');
for (const kind of [document, document.documentElement]) {
  const prototype = Object.getPrototypeOf(kind);
  prototype.querySelectorAll = function(selector) {
    return selector.split(',').flatMap(
        each => Array.from(this.getElementsByTagNameNS('*', each.trim().split(/\s+/).at(-1))));
  };
  prototype.querySelector = function(selector) { return this.querySelectorAll(selector)[0] ?? null; };
}

const hex = (color, alpha = 1) => {  // of a linear colour
  const byte = value => Math.round(255 * value).toString(16).padStart(2, '0');
  return `#${color.getHexString(THREE.SRGBColorSpace)}${alpha < 1 ? byte(alpha) : ''}`;
};

/// Volume, and area by colour, of triangles with a material or colours of their vertices.
function measure(geometry, materials, matrix, part) {
  const position = geometry.getAttribute('position'), index = geometry.getIndex();
  const vertexColors = geometry.getAttribute('color');
  const count = index ? index.count : position.count;
  const groups = geometry.groups.length ? geometry.groups : [{start: 0, count, materialIndex: 0}];
  const facing = Math.sign(matrix.determinant());  // a mirrored instance is turned by who draws it
  const vertex = i => new THREE.Vector3().fromBufferAttribute(position, i).applyMatrix4(matrix);
  for (const group of groups) {
    const material = Array.isArray(materials) ? materials[group.materialIndex ?? 0] : materials;
    for (let i = group.start; i < Math.min(group.start + group.count, count); i += 3) {
      const ids = [0, 1, 2].map(k => index ? index.getX(i + k) : i + k);
      const [a, b, c] = ids.map(vertex);
      part.volume += facing * a.dot(b.clone().cross(c)) / 6;
      const look = vertexColors ? new THREE.Color().fromBufferAttribute(vertexColors, ids[0]) :
                                  material?.color;
      const name = look ? hex(look, material?.opacity ?? 1) : 'none';
      part.colours[name] = (part.colours[name] ?? 0) + b.sub(a).cross(c.sub(a)).length() / 2;
    }
  }
}

/// The meshes below an object; several that have one named parent are one part, as primitives of a glTF
/// mesh are.
function partsOf(root) {
  const parts = new Map();
  root.updateMatrixWorld(true);
  root.traverse(object => {
    if (!object.isMesh) return;
    const primitive = object.parent?.isGroup && object.parent.name && object.parent !== root &&
        object.parent.children.every(each => each.isMesh);
    const owner = primitive ? object.parent : object;
    if (!parts.has(owner)) {
      const name = owner.userData?.name ?? owner.name;
      parts.set(owner, {name, volume: 0, colours: {}});
    }
    measure(object.geometry, object.material, object.matrixWorld, parts.get(owner));
  });
  return [...parts.values()];
}

const geometryParts = geometry => {
  const part = {name: '', volume: 0, colours: {}};
  measure(geometry, undefined, new THREE.Matrix4(), part);
  return [part];
};

function signedArea(points) {
  return points.reduce((sum, p, i) => {
    const q = points[(i + 1) % points.length];
    return sum + (p.x * q.y - q.x * p.y) / 2;
  }, 0);
}

/// Outer outlines and holes, told apart by the reader.
function svgParts(text) {
  return new loaders.SVGLoader().parse(text).paths.map(path => {
    let area = 0;
    for (const shape of path.toShapes()) {
      area += Math.abs(signedArea(shape.getPoints()));
      for (const hole of shape.holes) area -= Math.abs(signedArea(hole.getPoints()));
    }
    const name = path.userData.node.getAttribute('id') ?? '';
    return {name, area, colour: hex(path.color, path.userData.style.fillOpacity ?? 1)};
  });
}

/// By layer; an outline inside of another one is a hole.
function dxfParts(text) {
  const inside = (p, loop) => loop.reduce((odd, a, i) => {
    const b = loop[(i + 1) % loop.length];
    const crosses = (a.y > p.y) !== (b.y > p.y) &&
        p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x);
    return crosses ? !odd : odd;
  }, false);
  const dxf = new DxfParser().parseSync(text);
  const layers = new Map();
  for (const entity of dxf.entities) {
    if (entity.type !== 'LWPOLYLINE' || !entity.shape) throw Error(`a ${entity.type} that is open`);
    if (!layers.has(entity.layer)) layers.set(entity.layer, []);
    layers.get(entity.layer).push(entity.vertices);
  }
  return [...layers].map(([name, loops]) => {
    const area = loops.reduce((sum, loop) => {
      const depth = loops.filter(other => other !== loop && inside(loop[0], other)).length;
      return sum + (depth % 2 ? -1 : 1) * Math.abs(signedArea(loop));
    }, 0);
    return {name, area, units: dxf.header?.$INSUNITS};
  });
}

async function read(path) {
  const bytes = readFileSync(path);
  const buffer = bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.length);
  const text = () => bytes.toString('utf8');
  switch (extname(path)) {
    case '.stl': return geometryParts(new loaders.STLLoader().parse(buffer));
    case '.ply': return geometryParts(new loaders.PLYLoader().parse(buffer));
    case '.3mf': return partsOf(new loaders.ThreeMFLoader().parse(buffer));
    case '.obj': {
      const loader = new loaders.OBJLoader();
      const library = path.replace(/obj$/, 'mtl');
      if (existsSync(library)) {
        const materials = new loaders.MTLLoader().parse(readFileSync(library, 'utf8'), dirname(path));
        materials.preload();
        loader.setMaterials(materials);
      }
      return partsOf(loader.parse(text()));
    }
    case '.glb':
    case '.gltf': {
      const gltf = await new loaders.GLTFLoader().parseAsync(path.endsWith('b') ? buffer : text(), '');
      return partsOf(gltf.scene);
    }
    case '.svg': return svgParts(text());
    case '.dxf': return dxfParts(text());
    default: throw Error(`${path}: of no known format`);
  }
}

for (const file of process.argv.slice(2)) {
  console.log(JSON.stringify({file, parts: await read(file)}));
}
