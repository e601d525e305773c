// One camera for all views: round a point, dragged and zoomed.
// SPDX-License-Identifier: MIT

class Orbit {
  constructor(canvas, extent, views) {
    this.camera = new THREE.PerspectiveCamera(38, 1, 0.002 * extent.size, 120 * extent.size);
    this.extent = extent;
    this.views = views;
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
    this.target.y -= 0.03 * this.extent.size;  // the bar hides what is lowest
    this.distance = this.extent.size * this.fit();
    this.around = 0.72;
    this.up = 0.38;
    this.moved = true;
  }
  // How many times its size away one sees a ball whole, above the bar.
  fit() {
    const wide = innerWidth / this.views / Math.max(1, innerHeight),
          upright = THREE.MathUtils.degToRad(0.5 * this.camera.fov);
    return 0.47 / Math.sin(Math.min(0.88 * upright, Math.atan(wide * Math.tan(upright))));
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
    this.distance = Math.min(60, Math.max(0.02, this.distance / this.extent.size * factor)) * this.extent.size;
    this.moved = true;
  }
  place(aspect) {
    const flat = Math.cos(this.up) * this.distance;
    this.camera.position.set(
        this.target.x + flat * Math.sin(this.around), this.target.y + Math.sin(this.up) * this.distance,
        this.target.z + flat * Math.cos(this.around));
    this.camera.lookAt(this.target);
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    this.camera.updateMatrix();
    return this.camera;
  }
}
