import * as THREE from 'three';
import { LineMaterial } from 'three/addons/lines/LineMaterial.js';
import { LineSegments2 } from 'three/addons/lines/LineSegments2.js';
import { LineSegmentsGeometry } from 'three/addons/lines/LineSegmentsGeometry.js';
import { fillWithCopies, trianglesOfMaterials, withCopies } from './appearance.js';
import { trianglesOfFaces } from './conflicts.js';
import { trianglesOfFiles } from './files.js';
import { vertexNormals } from './faces.js';
import { clayMaterial, edgeMaterial, hiddenMaterial, overlayMaterial, paintedMaterial, sharedUniforms } from './materials.js';

/** Things are drawn in this order. */
const order = { clay: 0, held: 0.5, hiddenSelected: 1, hidden: 2, overlay: 3, selected: 4, edges: 5, hiddenCurves: 6, curves: 7 };

/** What three.js draws: the surface between two states, its conflicts, edges, curves and the selection. */
export class Surface {
  constructor(page, faces) {
    this.page = page;
    this.faces = faces;
    this.scene = new THREE.Scene();
    this.shared = sharedUniforms();
    this.copies = page.appearance?.copies;
    const a = this.#stateAttributes(page.before.positions);
    const b = page.after ? this.#stateAttributes(page.after.positions) : a;
    this.ends = { a, b };
    const heat = page.displacement ?? new Float32Array(page.before.positions.length / 3);
    this.heat = new THREE.BufferAttribute(withCopies(heat, 1, this.copies), 1);
    this.attributes = {
      position: a.position, normal: a.normal, positionB: b.position, normalB: b.normal, heat: this.heat,
    };
    this.clay = trianglesOfFiles(page).map((triangles) =>
      this.#mesh(new THREE.BufferAttribute(new Uint32Array(triangles), 1), clayMaterial(this.shared), order.clay));
    this.red = {
      before: this.#overlay(order.overlay, order.hidden, 0.38),
      after: this.#overlay(order.overlay, order.hidden, 0.38),
      frame: this.#overlay(order.overlay, order.hidden, 0.38),
    };
    this.held = this.#overlay(order.held, order.held, 0);
    this.selected = this.#overlay(order.selected, order.hiddenSelected, 0.62);
    this.partners = this.#overlay(order.selected, order.hiddenSelected, 0.62);
    this.curves = { before: this.#curves(page.before.curves), after: this.#curves(page.after?.curves) };
    this.edges = null;  // made when first wanted
    this.painted = null;  // likewise
  }

  /** In the colours and images of the file, or all of one colour? */
  setPainted(painted) {
    if (painted && !this.painted) {
      const { appearance } = this.page;
      const uv = appearance.uv && new THREE.BufferAttribute(appearance.uv, 2);
      this.painted = trianglesOfMaterials(this.page).map(({ material, file, triangles }) => {
        const mesh = this.#mesh(new THREE.BufferAttribute(triangles, 1), paintedMaterial(this.shared, material ?? {}), order.clay);
        if (material?.image) mesh.geometry.setAttribute('uv', uv);
        mesh.userData = { material, file };
        return mesh;
      });
      this.applyColours(this.colours);
    }
    for (const mesh of this.clay) mesh.visible = !painted;
    for (const mesh of this.painted ?? []) mesh.visible = painted;
  }

  /** Moves t between before and after again. */
  showEnds() {
    this.#use({ ...this.ends, heat: this.heat });
  }

  /** One state instead, of these positions and displacements, which are copied. */
  showState(positions, displacement) {
    this.state ??= {
      ...this.#stateAttributes(positions.slice()),
      heat: new THREE.BufferAttribute(withCopies(displacement.slice(), 1, this.copies), 1),
    };
    const { position, normal, heat } = this.state;
    fillWithCopies(position.array, positions, 3, this.copies);
    fillWithCopies(normal.array, vertexNormals(positions, this.page.triangles), 4, this.copies);
    fillWithCopies(heat.array, displacement, 1, this.copies);
    for (const attribute of [position, normal, heat]) attribute.needsUpdate = true;
    this.#use({ a: this.state, b: this.state, heat });
  }

  /** isChosen(face): which faces are red in this overlay ('before', 'after', 'frame'). */
  setRed(name, isChosen) {
    this.red[name].setFaces(isChosen);
  }

  /** flags: one a face, 1: it is drawn as held still. */
  setHeld(flags) {
    this.held.setFaces((f) => flags[f]);
  }

  select(face, partners) {
    const others = new Set(partners);
    this.selected.setFaces((f) => f === face);
    this.partners.setFaces((f) => others.has(f));
    this.selected.setStrength(1);
    this.partners.setStrength(0.85);
  }

  setEdgesShown(shown) {
    if (shown && !this.edges) {
      const geometry = this.#geometry(new THREE.BufferAttribute(this.faces.edges(), 1));
      this.edges = new THREE.LineSegments(geometry, edgeMaterial(this.shared));
      this.#place(this.edges, order.edges);
      this.applyColours(this.colours);
    }
    if (this.edges) this.edges.visible = shown;
  }

  /** How red the overlays are and how visible the curves, all in [0, 1]; see strengthsOf. */
  setStrengths({ before, after, frame, held, curvesBefore, curvesAfter }) {
    this.held.setStrength(held);
    this.red.before.setStrength(before);
    this.red.after.setStrength(after);
    this.red.frame.setStrength(frame);
    for (const [lines, strength] of [[this.curves.before, curvesBefore], [this.curves.after, curvesAfter]])
      for (const line of lines) {
        line.visible = strength > 0;
        line.material.opacity = strength * line.userData.opacity;
      }
  }

  /** Names as in theme.js. */
  applyColours(colours) {
    this.colours = colours;
    if (!colours) return;
    const set = (material, colour) => material.uniforms.colour.value.copy(colour);
    this.clay.forEach((mesh, i) => set(mesh.material, colours.files[i % colours.files.length]));
    for (const { material: drawn, userData: { material, file } } of this.painted ?? [])
      if (material) drawn.uniforms.colour.value.fromArray(material.colour);
      else set(drawn, colours.files[file % colours.files.length]);
    for (const overlay of Object.values(this.red)) overlay.setColour(colours.red, colours.tint);
    this.held.setColour(colours.held);
    this.selected.setColour(colours.selected);
    this.partners.setColour(colours.partner);
    this.shared.heatStops.value.forEach((stop, i) => stop.copy(colours.heat[i]));
    if (this.edges) set(this.edges.material, colours.edge);
    for (const line of [...this.curves.before, ...this.curves.after])
      line.material.color.setRGB(...colours.curve.toArray(), THREE.SRGBColorSpace);
  }

  #use({ a, b, heat }) {
    const attributes = { position: a.position, normal: a.normal, positionB: b.position, normalB: b.normal, heat };
    if (attributes.position === this.attributes.position) return;
    this.attributes = attributes;
    for (const geometry of this.#geometries())
      for (const [name, attribute] of Object.entries(attributes)) geometry.setAttribute(name, attribute);
  }

  #geometries() {
    const overlays = [...Object.values(this.red), this.held, this.selected, this.partners];
    const surfaces = [...this.clay, ...this.painted ?? []];
    return [...surfaces.map((m) => m.geometry), ...overlays.flatMap((o) => o.meshes.map((m) => m.geometry)), ...this.edges ? [this.edges.geometry] : []];
  }

  #stateAttributes(positions) {
    return {
      position: new THREE.BufferAttribute(withCopies(positions, 3, this.copies), 3),
      normal: new THREE.BufferAttribute(withCopies(vertexNormals(positions, this.page.triangles), 4, this.copies), 4, true),
    };
  }

  #geometry(index) {
    const geometry = new THREE.BufferGeometry();
    for (const [name, attribute] of Object.entries(this.attributes)) geometry.setAttribute(name, attribute);
    geometry.setIndex(index);
    return geometry;
  }

  #place(object, renderOrder) {
    object.renderOrder = renderOrder;
    object.frustumCulled = false;  // vertices move in the shader
    this.scene.add(object);
    return object;
  }

  #mesh(index, material, renderOrder) {
    return this.#place(new THREE.Mesh(this.#geometry(index), material), renderOrder);
  }

  /** Some of the faces in a colour of their own; where they are hidden they show through as a tint. */
  #overlay(renderOrder, hiddenOrder, tintOpacity) {
    let index = new THREE.BufferAttribute(new Uint32Array(0), 1);
    let count = 0;
    const solid = this.#mesh(index, overlayMaterial(this.shared), renderOrder);
    const hidden = this.#mesh(index, hiddenMaterial(this.shared), hiddenOrder);
    const meshes = [solid, hidden];
    for (const mesh of meshes) mesh.visible = false;
    return {
      meshes,
      setFaces: (isChosen) => {
        const corners = trianglesOfFaces(this.page.triangles, this.page.triangleFaces, isChosen);
        if (index.array.length < corners.length) {  // grows seldom, as the old one stays on the graphics card
          index = new THREE.BufferAttribute(new Uint32Array(2 ** Math.ceil(Math.log2(corners.length))), 1);
          for (const mesh of meshes) mesh.geometry.setIndex(index);
        }
        index.array.set(corners);
        index.needsUpdate = true;
        count = corners.length;
        for (const mesh of meshes) mesh.geometry.setDrawRange(0, count);
      },
      setStrength: (strength) => {
        for (const mesh of meshes) mesh.visible = strength > 0.005 && count > 0;
        hidden.visible &&= tintOpacity > 0;
        solid.material.uniforms.opacity.value = strength;
        hidden.material.uniforms.opacity.value = tintOpacity * strength;
      },
      setColour: (colour, tint = colour) => {
        solid.material.uniforms.colour.value.copy(colour);
        hidden.material.uniforms.colour.value.copy(tint);
      },
    };
  }

  /** The same segments twice: where they are seen, and faintly where they are hidden. */
  #curves(points) {
    if (!points?.length) return [];
    const geometry = new LineSegmentsGeometry().setPositions(points);
    return [[order.curves, THREE.LessEqualDepth, 1, 2.2], [order.hiddenCurves, THREE.GreaterDepth, 0.45, 1.4]].map(
      ([renderOrder, depthFunc, opacity, linewidth]) => {
        const material = new LineMaterial({ linewidth, transparent: true, depthWrite: false, depthFunc, opacity });
        const line = this.#place(new LineSegments2(geometry, material), renderOrder);
        line.userData.opacity = opacity;
        return line;
      });
  }
}
