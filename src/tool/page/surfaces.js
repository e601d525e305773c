// The surfaces of hulls and meshes (surfaces.cpp packs them): any number of different ones drawn in one call.
// SPDX-License-Identifier: MIT

const kCornersWide = 1024;  // [texels] of a row of the texture of corners

// A thousand different hulls as a thousand meshes keep a browser busy. So the corners of all triangles lie in one
// texture, each mesh draws surfaces of like size as instances, and each instance finds its own corners there.
class Surfaces {
  constructor(reader) {
    this.all = [];
    this.corners = [];  // x y z and one number unused, three corners a triangle
    for (let left = reader.u32(); left > 0; --left) this.read(reader);
    const rows = Math.max(1, Math.ceil(this.corners.length / 4 / kCornersWide));
    const texels = new Float32Array(4 * kCornersWide * rows);
    texels.set(this.corners);
    this.corners = texels;
    this.texture = new THREE.DataTexture(texels, kCornersWide, rows, THREE.RGBAFormat, THREE.FloatType);
    this.texture.needsUpdate = true;
  }
  read(reader) {
    const vertices = reader.u32(), triangles = reader.u32();
    const three = (next) => [next(), next(), next()], low = three(() => reader.f32()), step = three(() => reader.f32());
    const places = [];
    for (let i = 0; i < vertices; ++i) places.push(three(() => reader.u16()).map((x, k) => low[k] + x * step[k]));
    const surface = {first: this.corners.length / 4, triangles, half: [0, 0, 0]};
    for (const place of places) surface.half = surface.half.map((h, k) => Math.max(h, Math.abs(place[k])));
    for (let i = 0; i < 3 * triangles; ++i) {
      const at = vertices <= 0x100 ? reader.u8() : vertices <= 0x10000 ? reader.u16() : reader.u32();
      this.corners.push(...places[at], 0);
    }
    this.all.push(surface);
  }

  // Parts that have a surface get the sizes that other parts have: of a box about their origin that holds it.
  fit(actors) {
    for (const actor of actors) {
      for (const part of actor.parts || []) {
        if (part.surface !== undefined) Object.assign(part, {half: this.all[part.surface].half, radius: 0});
      }
    }
  }

  // The list of those that are drawn with this one: up to twice as many triangles.
  listOf(index) {
    return 'surface' + Math.ceil(Math.log2(this.all[index].triangles));
  }
  // An instance for each of the parts, all of one list; `fixed`: of what nothing moves, tinted by slope.
  mesh(parts, material, fixed) {
    const most = Math.max(...parts.map((part) => this.all[part.surface].triangles));
    const spans = new Float32Array(2 * parts.length);
    parts.forEach(({surface}, i) => spans.set([this.all[surface].first, 3 * this.all[surface].triangles], 2 * i));
    const geometry = new THREE.BufferGeometry();
    geometry.setAttribute('position', new THREE.BufferAttribute(new Float32Array(9 * most), 3));  // counts alone
    geometry.setAttribute('span', new THREE.InstancedBufferAttribute(spans, 2));
    const mesh = new THREE.InstancedMesh(geometry, this.finding(material, fixed), parts.length);
    mesh.customDepthMaterial = this.finding(new THREE.MeshDepthMaterial({depthPacking: THREE.RGBADepthPacking}));
    return mesh;
  }
  // A material whose vertices are corners from the texture, their normals across their triangle.
  finding(material, fixed) {
    material.onBeforeCompile = (shader) => {
      shader.uniforms.corners = {value: this.texture};
      shader.vertexShader = shader.vertexShader.replace('#include <common>', kCornerShader)
                                .replace('#include <beginnormal_vertex>', 'vec3 objectNormal = normalHere();')
                                .replace('#include <begin_vertex>', 'vec3 transformed = cornerHere(gl_VertexID);');
      if (fixed)
        shader.vertexShader = shader.vertexShader.replace('#include <color_vertex>', '#include <color_vertex>\n' + kTint);
    };
    return material;
  }

  // For the edges of walls.
  geometry(index) {
    const {first, triangles} = this.all[index], geometry = new THREE.BufferGeometry(), places = [];
    for (let i = 4 * first; i < 4 * (first + 3 * triangles); i += 4) places.push(...this.corners.subarray(i, i + 3));
    geometry.setAttribute('position', new THREE.Float32BufferAttribute(places, 3));
    return geometry;
  }
}

// What is level looks like ground, what is upright like a wall, and slopes like roofs.
const kTint = `
float rise = normalize(mat3(instanceMatrix) * normalHere()).y;
vec3 slope = mix(vec3(1.0, 0.98, 0.94), vec3(0.98, 0.86, 0.74), smoothstep(0.1, 0.4, rise));
vColor.rgb *= mix(slope, vec3(0.83, 0.9, 0.76), smoothstep(0.9, 0.995, rise));
`;

// Beyond its own triangles an instance draws points, of which nothing is seen.
const kCornerShader = `
#include <common>
uniform highp sampler2D corners;
attribute vec2 span;
vec3 cornerHere(int i) {
  if (i >= int(span.y)) return vec3(0.0);
  int texel = int(span.x) + i;
  return texelFetch(corners, ivec2(texel % ${kCornersWide}, texel / ${kCornersWide}), 0).xyz;
}
vec3 normalHere() {
  int i = gl_VertexID - gl_VertexID % 3;
  if (i >= int(span.y)) return vec3(0.0, 1.0, 0.0);
  vec3 a = cornerHere(i);
  return normalize(cross(cornerHere(i + 1) - a, cornerHere(i + 2) - a));
}
`;
