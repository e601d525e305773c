// The player: time and panels.
// SPDX-License-Identifier: MIT

const kHere = (id) => document.getElementById(id);
const kFilm = JSON.parse(kHere('film').textContent);

class Player {
  constructor(runs, surfaces) {
    this.runs = runs;
    this.count = Math.min(...runs.map((run) => run.count));
    this.time = 0;  // in frames of the recording
    this.playing = true;
    this.wanted = new URLSearchParams(location.hash.slice(1));
    const parted = kFilm.divergence && kFilm.divergence.frame >= 0 ? kFilm.divergence : null;
    this.parted = parted;
    const extent = extentOf(runs[0]);
    this.canvas = kHere('canvas');
    this.renderer = new THREE.WebGLRenderer({canvas: this.canvas, antialias: true, preserveDrawingBuffer: true});
    this.renderer.debug.onShaderError = (gl, program, vertex, fragment) =>
        pageErrors.push(gl.getShaderInfoLog(vertex) || gl.getShaderInfoLog(fragment) || gl.getProgramInfoLog(program));
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFSoftShadowMap;
    this.views = runs.map((run) => new View(run, surfaces, extent, parted && this.markIn(run)));
    this.orbit = new Orbit(this.canvas, extent, runs.length);
    this.addHeads();
    this.listen();
    this.obey();
  }
  // The body that parted is who has its id at that frame; in a run that lacks it, nobody.
  markIn(run) {
    const {frame, id, generation} = this.parted;
    const actor = run.actors.findIndex(
        (one) => one.id === id && (one.generation || 0) === generation && one.type !== 'wheel');
    return actor < 0 ? null : {actor, frame};
  }

  addHeads() {
    for (const run of this.runs) {
      const head = document.createElement('div'), {about} = run;
      head.className = 'head';
      head.innerHTML = '<h1></h1><div class="how"></div><div class="hash"></div><div class="read"></div>';
      head.querySelector('h1').append(
          kFilm.scene + ' ', Object.assign(document.createElement('em'), {textContent: about.scalar}));
      head.querySelector('.how').textContent = `${about.solver}, ${about.hz} Hz, ${about.substeps} sub-steps`;
      kHere('heads').append(head);
    }
    kHere('scrub').max = this.count - 1;
    const offer = (id, is) => {
      kHere(id).parentElement.hidden = !is;
    };
    this.followed = this.parted ? this.views[0].parted : this.views[0].extent.focus;
    offer('follow', this.followed);
    kHere('follow-name').textContent = this.parted ? 'follow the parted body' : 'follow the body';
    kHere('follow').checked = !this.parted && this.followed !== null;
    offer('effects', this.runs.some((run) => run.about.effects.length > 0));
    offer('joints', this.runs.some((run) => run.about.bonds.length > 0));
    for (const id of ['contacts', 'sleep']) offer(id, !this.runs[0].about.particles);
    if (this.runs[0].about.particles) kHere('joints-name').textContent = 'springs and links';
    else if (this.runs[0].about.bonds.some(isTie)) kHere('joints-name').textContent = 'joints and springs';
    if (this.parted) {
      kHere('parted').textContent = `parts at frame ${this.tick(this.parted.frame)}`;
      kHere('parted').onclick = () => this.jump(this.parted.frame);
    }
  }
  tick(frame) {
    return this.runs[0].frames[frame].tick;
  }
  get frame() {
    return Math.min(this.count - 1, Math.floor(this.time + 1e-6));
  }

  listen() {
    kHere('play').onclick = () => this.toggle();
    kHere('first').onclick = () => this.jump(0);
    kHere('back').onclick = () => this.jump(this.frame - 1);
    kHere('next').onclick = () => this.jump(this.frame + 1);
    kHere('home').onclick = () => this.orbit.home();
    kHere('scrub').oninput = (event) => this.jump(Number(event.target.value));
    for (const id of ['contacts', 'joints', 'effects', 'sleep']) kHere(id).onchange = () => this.recolour();
    kHere('follow').onchange = () => {
      this.orbit.near = kHere('follow').checked && this.views[0].extent.focus !== null;
      this.orbit.home();
    };
    addEventListener('resize', () => {
      this.orbit.moved = true;
    });
    addEventListener('keydown', (event) => {
      const act = {
        ' ': () => this.toggle(),
        ArrowLeft: () => this.jump(this.frame - 1),
        ArrowRight: () => this.jump(this.frame + 1),
        Home: () => this.jump(0),
        End: () => this.jump(this.count - 1),
        h: () => this.orbit.home()
      }[event.key];
      if (!act || event.target.tagName === 'SELECT') return;
      event.preventDefault();
      act();
    });
  }
  // What the address asks for: #frame=120&contacts&speed=0.25&around=1&up=0.3&zoom=0.8
  obey() {
    const number = (name, otherwise) => this.wanted.has(name) ? Number(this.wanted.get(name)) : otherwise;
    for (const id of ['contacts', 'joints', 'effects', 'sleep', 'follow']) {
      if (this.wanted.has(id)) kHere(id).checked = this.wanted.get(id) !== '0';
    }
    kHere('follow').onchange();
    if (this.wanted.has('speed')) kHere('speed').value = this.wanted.get('speed');
    if (this.wanted.has('frame')) this.jump(number('frame', 0) / kFilm.every);
    this.orbit.around = number('around', this.orbit.around);
    this.orbit.up = number('up', this.orbit.up);
    this.orbit.zoom(number('zoom', 1));
  }

  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.frame === this.count - 1) this.time = 0;
    this.stale = true;
  }
  jump(frame) {
    this.playing = false;
    this.time = Math.min(this.count - 1, Math.max(0, Math.round(frame)));
    this.stale = true;
  }
  recolour() {
    this.stale = true;
  }

  // `seconds` since the last call.
  advance(seconds) {
    if (!this.playing) return;
    const rate = this.runs[0].about.hz / kFilm.every;
    this.time += Math.min(Math.max(seconds, 0), 0.1) * rate * Number(kHere('speed').value);
    if (this.time >= this.count - 1) {
      this.time = this.count - 1;
      this.playing = false;
    }
    this.stale = true;
  }

  draw() {
    const {frame} = this, share = this.playing ? this.time - frame : 0;
    if (this.stale || this.stale === undefined) {
      const options = {
        contacts: kHere('contacts').checked,
        joints: kHere('joints').checked,
        effects: kHere('effects').checked,
        sleep: kHere('sleep').checked
      };
      for (const view of this.views) view.show(frame, Math.max(0, share), options);
      this.read(frame);
    }
    if (this.stale === false && !this.orbit.moved) return;
    if (kHere('follow').checked && this.followed) this.views[0].position(this.followed.actor, this.orbit.target);
    this.stale = this.orbit.moved = false;
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    this.renderer.setSize(width, height, false);
    this.renderer.setScissorTest(true);
    this.views.forEach((view, i) => {
      const wide = width / this.views.length;
      this.renderer.setViewport(i * wide, 0, wide, height);
      this.renderer.setScissor(i * wide, 0, wide - (i + 1 < this.views.length ? 1 : 0), height);
      this.renderer.render(view.scene, this.orbit.place(wide / height));
    });
    this.graph();
  }

  read(frame) {
    const hashes = this.runs.map((run) => run.frames[frame].hash);
    this.runs.forEach((run, i) => {
      const head = kHere('heads').children[i], now = run.frames[frame];
      let here = 0, asleep = 0;
      for (let actor = 0; actor < run.actors.length; ++actor) {
        const {type} = run.actors[actor];
        if (run.state(frame, actor) === kGone || type === 'static' || type === 'wheel') continue;
        ++here;
        asleep += run.state(frame, actor) === kAsleep ? 1 : 0;
      }
      head.querySelector('.hash').textContent = 'hash ' + hashes[i];
      const what = run.about.particles ? `${here} particles` : `${here} bodies, ${asleep} asleep`;
      const depth = run.about.particles ? '' : `\ndeepest contact ${(1000 * now.depth).toFixed(2)} mm`;
      const apart =
          i === 1 ? `\nfarthest from ${this.runs[0].about.scalar} ${lengthText(kFilm.divergence.apart[frame])}` : '';
      head.querySelector('.read').textContent = `${what}\nenergy ${now.energy.toPrecision(5)} J${depth}${apart}`;
    });
    const tick = this.tick(frame), seconds = tick / this.runs[0].about.hz;
    kHere('clock').textContent = `frame ${tick} of ${this.tick(this.count - 1)}   ${seconds.toFixed(2)} s`;
    kHere('scrub').value = frame;
    kHere('play').classList.toggle('playing', this.playing);
  }

  // Over the frames: how far two runs are apart, on a scale of decades; of one run its energy.
  graph() {
    const canvas = kHere('graph'), width = canvas.clientWidth, height = canvas.clientHeight;
    if (canvas.width === width && this.graphed) return;
    this.graphed = true;
    canvas.width = width;
    canvas.height = height;
    const paint = canvas.getContext('2d'), two = this.runs.length > 1;
    const decade = (x) => Math.log10(Math.max(x, 2e-4));  // [m] nearer is what rounding for the page leaves
    const values = two ? kFilm.divergence.apart.map(decade) : this.runs[0].frames.map((frame) => frame.energy);
    const least = two ? decade(0) : values[0], most = two ? decade(kFilm.divergence.tolerance) : values[0];
    const low = values.reduce((a, b) => Math.min(a, b), least), high = values.reduce((a, b) => Math.max(a, b), most);
    const x = (frame) => 8 + (width - 16) * frame / Math.max(1, this.count - 1);
    paint.strokeStyle = two ? '#d0674d' : '#9fb3cc';
    paint.lineWidth = 1.25;
    paint.beginPath();
    values.forEach(
        (value, frame) => paint.lineTo(x(frame), 2 + 13 * (1 - (high > low ? (value - low) / (high - low) : 0))));
    paint.stroke();
    if (!this.parted) return;
    paint.fillStyle = '#e2361d';
    paint.fillRect(x(this.parted.frame) - 1, 0, 2, height);
  }

  // How many colours the middle of the picture has: one, where nothing was drawn.
  shades() {
    const gl = this.renderer.getContext(), {drawingBufferWidth: width, drawingBufferHeight: height} = gl,
          seen = new Set();
    const row = new Uint8Array(4 * width);
    for (let k = 1; k < 8; ++k) {
      gl.readPixels(0, Math.floor(k * height / 8), width, 1, gl.RGBA, gl.UNSIGNED_BYTE, row);
      for (let i = 0; i < row.length; i += 4) seen.add(row[i] << 16 | row[i + 1] << 8 | row[i + 2]);
    }
    return seen.size;
  }

  // What a test reads: after the first picture.
  check() {
    const last = this.runs.map((run) => run.frames[run.count - 1].hash).join(' ');
    const parted = this.parted ? this.tick(this.parted.frame) : 'never';
    kHere('check').textContent =
        `ready frames ${this.runs.map((run) => run.count).join(' ')} last ${last} parted ${parted} ` +
        `shades ${this.shades()} effects ${this.runs[0].about.effects.length} errors ${pageErrors.length}`;
  }
}

function lengthText(metres) {
  return metres < 1 ? `${(1000 * metres).toFixed(2)} mm` : `${metres.toFixed(2)} m`;
}

function begin() {
  const runs = [new DecodedRun(kFilm.runs[0], kHere('run').textContent)];
  if (kFilm.runs.length > 1) runs.push(new DecodedRun(kFilm.runs[1], kHere('beside').textContent));
  const surfaces = new Surfaces(new ByteReader(bytesOf(kHere('surfaces').textContent)));
  for (const run of runs) surfaces.fit(run.actors);
  const player = new Player(runs, surfaces);
  let before = performance.now(), checked = false;
  const tick = (now) => {
    player.advance((now - before) / 1000);
    before = now;
    player.draw();
    if (!checked) player.check();
    checked = true;
    requestAnimationFrame(tick);
  };
  requestAnimationFrame(tick);
}
begin();
