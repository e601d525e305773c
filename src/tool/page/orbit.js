// One camera for all views: round a point, dragged and zoomed.
// SPDX-License-Identifier: MIT

class Orbit {
  constructor(canvas, extent, views) {
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.002 * extent.scale, 120 * extent.size);
    this.extent = extent;
    this.views = views;
    this.near = extent.focus !== null;  // the body that the extent's focus is, not everything
    this.home();
    const fingers = new Map();
    canvas.addEventListener('pointerdown', (event) => {
      canvas.setPointerCapture(event.pointerId);
      fingers.set(event.pointerId, event);
    });
    for (const over of ['pointerup', 'pointercancel'])
      canvas.addEventListener(over, (event) => fingers.delete(event.pointerId));
    canvas.addEventListener('pointermove', (event) => {
      const before = fingers.get(event.pointerId);
      if (!before) return;
      const dx = event.clientX - before.clientX, dy = event.clientY - before.clientY;
      fingers.set(event.pointerId, event);
      if (fingers.size === 2)
        this.zoom(Math.exp(-0.004 * dy)), this.pan(0.5 * dx, 0);
      else if (event.buttons & 2 || event.shiftKey || event.ctrlKey)
        this.pan(dx, dy);
      else
        this.turn(dx, dy);
    });
    canvas.addEventListener('contextmenu', (event) => event.preventDefault());
    canvas.addEventListener('wheel', (event) => {
      event.preventDefault();
      this.zoom(Math.exp(0.0012 * event.deltaY));
    }, {passive: false});
  }
  home() {
    this.target = this.extent.centre.clone();
    this.around = this.near ? -0.5 : 0.72;
    this.up = 0.38;
    this.distance = this.near ? 1.3 * this.extent.scale : this.fit();
    this.moved = true;
  }
  // [m] From where one sees the extent's box whole, above the bar.
  fit() {
    const tangent = Math.tan(THREE.MathUtils.degToRad(0.5 * this.camera.fov)), upright = tangent * (1 - this.hidden()),
          wide = tangent * innerWidth / this.views / Math.max(1, innerHeight);
    const back = this.back(), right = new THREE.Vector3(back.z, 0, -back.x).normalize(),
          top = new THREE.Vector3().crossVectors(back, right), {min, max} = this.extent.box;
    let least = 0.2 * this.extent.size;
    for (let i = 0; i < 8; ++i) {
      const corner = new THREE.Vector3(i & 1 ? min.x : max.x, i & 2 ? min.y : max.y, i & 4 ? min.z : max.z);
      corner.sub(this.target);
      const beside = Math.max(Math.abs(corner.dot(right)) / wide, Math.abs(corner.dot(top)) / upright);
      least = Math.max(least, corner.dot(back) + beside);
    }
    return 1.12 * least;
  }
  // The share of the height that the bar hides, below.
  hidden() {
    return Math.min(0.4, (document.getElementById('bar').offsetHeight + 16) / Math.max(1, innerHeight));
  }
  // From the target to the camera.
  back() {
    const flat = Math.cos(this.up);
    return new THREE.Vector3(flat * Math.sin(this.around), Math.sin(this.up), flat * Math.cos(this.around));
  }
  turn(dx, dy) {
    this.around -= 0.006 * dx;
    this.up = Math.min(1.55, Math.max(-1.55, this.up + 0.006 * dy));
    this.moved = true;
  }
  pan(dx, dy) {
    const step = 0.0014 * this.distance, e = this.camera.matrix.elements;
    this.target.addScaledVector(new THREE.Vector3(e[0], e[1], e[2]), -dx * step);
    this.target.addScaledVector(new THREE.Vector3(e[4], e[5], e[6]), dy * step);
    this.moved = true;
  }
  zoom(factor) {
    const {size, scale} = this.extent;
    this.distance = Math.min(60 * size, Math.max(0.02 * scale, this.distance * factor));
    this.moved = true;
  }
  place(aspect) {
    this.camera.position.copy(this.target).addScaledVector(this.back(), this.distance);
    this.camera.lookAt(this.target);
    this.camera.aspect = aspect;
    this.camera.setViewOffset(aspect, 1, 0, 0.5 * this.hidden(), aspect, 1);  // the target is in the middle of the rest
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrix();
    return this.camera;
  }
}
