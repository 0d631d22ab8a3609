/* The star in the page: an agent with 100 minutes of experience, one without, and a star to drag.

- The rules are those of star.py. Each agent has a worker of its own, which advances only on request. The lesson, and
  every request, is short, so that the page stays responsive; out of view, or paused, none is made.
- `life` holds all that the page knows of the two runs, and is replaced as a whole; answers to requests of an earlier
  one are dropped. What is shown is measured in the frames of the two runs, weighted by time. */

const SPEED = 2; // times real time
const [LESSON_BUDGET, MOST_SECONDS] = [24, 0.1]; // milliseconds of each request; simulated seconds behind real time
const [PERIOD, CALM, NUMBERS] = [60, 500, 250]; // seconds measured; milliseconds between drawings, and between numbers
const [STEP, EDGE] = [0.04, 0.03]; // of the arrow keys, and the star's distance to the walls, in board widths
const DAY = 86_400; // seconds, after which a run begins again
const ARROWS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowRight: [1, 0], ArrowLeft: [-1, 0] };
const STOPPED = "The agents have stopped. Reload the page to begin again.";

class Star {
  constructor(root, data) {
    Object.assign(this, { root, data, star: data.star, forgetful: false, redIsGood: false, life: null, engines: [],
      isPlaying: !matchMedia("(prefers-reduced-motion: reduce)").matches, inSight: false, drawn: 0, numbered: 0 });
    this.calm = !this.isPlaying;
    [this.tank, this.other, this.distance] = root.querySelectorAll("canvas");
    this.handle = root.querySelector(".star");
    this.listen();
  }

  listen() {
    const { root, handle, tank } = this;
    const on = (target, type, act) => target.addEventListener(type, this.safely(act));
    on(root.querySelector(".buttons"), "click", ({ target }) => this.press(target.dataset.action));
    on(handle, "pointerdown", ({ pointerId }) => handle.setPointerCapture(pointerId));
    on(handle, "pointermove", (event) => handle.hasPointerCapture(event.pointerId) && this.move(this.placeOf(event)));
    on(tank, "click", (event) => this.life?.frames && this.move(this.placeOf(event)));
    on(handle, "keydown", (event) => {
      const [x, y] = ARROWS[event.key] ?? [];
      if (x === undefined) return;
      event.preventDefault();
      this.move({ x: this.star.x + STEP * x, y: this.star.y + STEP * y });
    });
    watchLook([tank, this.other, this.distance], () => this.wake());
    new IntersectionObserver(this.safely((entries) => {
      this.inSight = entries.at(-1).isIntersecting;
      if (this.inSight && !this.life) return this.live();
      return this.wake();
    })).observe(root);
  }

  placeOf({ clientX, clientY }) {
    const { left, top, width, height } = this.tank.getBoundingClientRect();
    return { x: placeAt((clientX - left) / width), y: placeAt((clientY - top) / height) };
  }

  press(action) {
    if (action === "play") this.isPlaying = !this.isPlaying;
    if (action === "red") this.redIsGood = !this.redIsGood, this.life.isChanged = true;
    if (action === "forget") this.forgetful = !this.forgetful, this.live();
    this.wake();
  }

  move(place) {
    const [x, y] = [place.x, place.y].map((side) => Math.min(1 - EDGE, Math.max(EDGE, side)));
    Object.assign(this, { star: { x, y } });
    Object.assign(this.life, { isChanged: true, past: [] });
    this.root.dataset.seconds = 0;
    this.wake();
  }

  /** The agent's parameters, with the star and the valence of red. */
  parameters({ withStar = true } = {}) {
    const { data: { valence, red }, star, redIsGood } = this;
    const parameters = structuredClone(this.data.parameters);
    if (!withStar) return parameters;
    for (const e of red) parameters.desires[e].valence = redIsGood ? 1 : -1;
    const source = this.data._layout.plane.enumerations.Source.place;
    parameters.names.forEach((_, n) => addElement(parameters, n, source, { ...star, valence }));
    return parameters;
  }

  // The two runs

  /** Begin both runs, after the first agent's lesson unless it is to know nothing. */
  async live() {
    const { data: { world, seed, lesson }, forgetful } = this;
    const life = this.life = { frames: null, past: [], curves: [], owed: 0, isChanged: false, isBusy: false };
    if (!this.engines.length) {
      const model = { get: (name) => this.data[name] };
      this.engines = [0, 1].map(() => startEngine(model, (message) => this.fail(message)));
    }
    const steps = DAY * world.fps;
    const begin = { type: "begin", world, seed, run: 0, steps, bin_steps: steps, map: "", heat: 0, field: 0 };
    this.show("learning", 0);
    if (!forgetful) {
      const alone = this.parameters({ withStar: false });
      await this.ask({ ...begin, parameters: alone, seed: seed + 1, steps: lesson, bin_steps: lesson });
      for (let frame = {}; !frame.ended;) {
        frame = await this.ask({ type: "advance", steps: lesson, budget: LESSON_BUDGET });
        if (life !== this.life) return;
        this.show("learning", frame.step / world.fps / 60);
        if (!this.calm) drawArena(this.tank, readColours(this.root), bare(frame));
      }
    }
    const parameters = this.parameters(); // the star may have been moved in the meantime
    const frames = await Promise.all([
      // An agent that forgets has another run, or the two would be the same to the last bit.
      this.ask({ ...begin, parameters, run: Number(forgetful), keeps: !forgetful, field: FIELD_TILES }),
      this.ask({ ...begin, parameters }, 1)]);
    if (life !== this.life) return;
    Object.assign(life, { frames, isChanged: true });
    this.show("paused");
    this.wake();
  }

  ask(request, engine = 0) {
    return this.engines[engine].ask(request);
  }

  isRunning() {
    return this.isPlaying && this.inSight && Boolean(this.life?.frames);
  }

  async advance(steps) {
    const { life } = this;
    life.isBusy = true;
    if (life.isChanged) {
      life.isChanged = false;
      const change = { type: "change", parameters: this.parameters() };
      const frames = await Promise.all([this.ask(change), this.ask(change, 1)]);
      if (life !== this.life) return;
      life.frames = frames;
    }
    if (steps) {
      const request = { type: "advance", steps, budget: Infinity };
      life.frames = await Promise.all([this.ask(request), this.ask(request, 1)]);
      if (life !== this.life) return;
      this.measure(life);
      if (life.frames[0].ended) await this.live();
    }
    life.isBusy = false;
    this.wake();
  }

  /** Keep the distances and the captures of the last minute. */
  measure(life) {
    const sample = this.sample(life.frames);
    const isRecent = ({ at }) => sample.at - at <= PERIOD;
    life.past = [...life.past, sample].filter(isRecent);
    life.curves = [...life.curves, sample].filter(isRecent);
  }

  sample(frames) {
    const { star, data: { world: { fps } } } = this;
    const distances = frames.map(({ agent }) => Math.hypot(agent.x - star.x, agent.y - star.y));
    const hits = frames.map((frame) => frame.hits.map(({ counts: [count] }) => count)); // of the single bin of the run
    return { at: frames[0].step / fps, distances, hits };
  }

  // What is shown

  wake() {
    this.asked ??= requestAnimationFrame(this.safely((now) => this.tick(now)));
  }

  tick(now) {
    const { life, data: { world: { fps } } } = this;
    this.asked = null;
    const elapsed = Math.min((now - (this.before ?? now)) / 1000, MOST_SECONDS);
    this.before = this.isRunning() ? now : null;
    if (life?.frames) {
      if (this.isRunning()) {
        this.show("running");
        life.owed = Math.min(life.owed + SPEED * elapsed * fps, SPEED * MOST_SECONDS * fps);
        this.wake();
      } else this.show("paused");
      const steps = this.isRunning() ? Math.floor(life.owed) : 0;
      if (!life.isBusy && (steps || life.isChanged)) life.owed -= steps, this.safely(() => this.advance(steps))();
    }
    if (!this.calm || !this.isRunning() || now - this.drawn >= CALM) this.draw(now);
  }

  show(state, minutes = 0) {
    const { root, forgetful, isPlaying, redIsGood, data: { lesson, world: { fps } } } = this;
    const whole = lesson / fps / 60;
    const lived = { learning: `It learns for ${whole} minutes: ${Math.floor(minutes)} …`,
      failed: "" }[state] ?? (forgetful ? "It has forgotten everything." :
      `It has learned for ${whole} minutes, without a star.`);
    root.querySelector(".lived").textContent = lived;
    if (root.dataset.state !== state) {
      root.dataset.state = state;
      root.querySelector("[role=status]").textContent = state === "learning" ? "" : lived;
    }
    this.handle.hidden = !["running", "paused"].includes(state);
    root.querySelector("[data-action=play]").textContent = isPlaying ? "Pause" : "Play";
    for (const [action, pressed] of [["forget", forgetful], ["red", redIsGood]]) {
      root.querySelector(`[data-action=${action}]`).ariaPressed = pressed;
    }
  }

  draw(now) {
    const { root, tank, other, handle, star, life } = this;
    this.drawn = now;
    if (!life?.frames) return;
    const colours = readColours(root);
    const [mine, theirs] = life.frames.map(bare);
    drawArena(tank, colours, mine, { trail: true });
    drawArena(other, { ...colours, agent: colours.place }, theirs, { trail: true });
    this.drawStar(other, colours);
    handle.style.left = `${100 * shareOf(star.x)}%`;
    handle.style.top = `${100 * shareOf(star.y)}%`;
    const [across, down] = [star.x, star.y].map((side) => Math.round(100 * side));
    handle.ariaLabel = `The star, ${across} % from the left and ${down} % from the top: drag it, or use the arrow keys.`;
    if (now - this.numbered >= NUMBERS || !this.isRunning()) this.showNumbers(colours, now);
  }

  drawStar(canvas, colours) {
    const unit = canvas.clientWidth / (1 + 2 * BOARD_MARGIN);
    write({ context: canvas.getContext("2d"), colours }, "★", this.star.x * unit, this.star.y * unit, "20px",
      colours.goal, colours.paper);
  }

  /** Write the numbers of the last minute, or of the time since the star was moved, and draw the distances. */
  showNumbers(colours, now) {
    const { root, distance, life: { past, curves, frames } } = this;
    this.numbered = now;
    const [first, last] = past.length ? [past[0], past.at(-1)] : [this.sample(frames), this.sample(frames)];
    const seconds = last.at - first.at;
    root.querySelector(".period").textContent = `The last ${Math.round(seconds)} s`;
    root.querySelectorAll("tbody tr").forEach(({ cells }, which) => {
      const sum = past.slice(1).reduce((total, { at, distances }, before) =>
        total + (at - past[before].at) * distances[which], 0);
      const caught = [0, 1].map((kind) => last.hits[which][kind] - first.hits[which][kind]);
      [(sum / seconds).toFixed(2), ...caught].forEach((number, column) => {
        cells[column + 1].textContent = seconds ? number : "–";
      });
    });
    drawDistances(distance, colours, curves);
    Object.assign(root.dataset, { step: frames[0].step, seconds: Math.round(seconds),
      at: [frames[0].agent.x, frames[0].agent.y].join(" ") });
  }

  // Failures

  safely(act) {
    return guarded(act, (message) => this.fail(message));
  }

  fail(message = STOPPED) {
    for (const engine of this.engines) engine.stop();
    Object.assign(this, { engines: [], life: { frames: null } });
    this.show("failed");
    Object.assign(this.root.querySelector("[role=alert]"), { hidden: false, textContent: message });
  }
}

/** A frame without maps and desires. */
const bare = (frame) => ({ ...frame, seen: null, nodes: [], landings: [] });

/** Draw the distances of both agents to the star over the last minute, in board widths. */
function drawDistances(canvas, colours, curves) {
  const board = { context: fittedContext(canvas), colours };
  const [left, top, right, bottom] = [30, 8, canvas.clientWidth - 4, canvas.clientHeight - 18];
  const end = Math.max(PERIOD, curves.at(-1)?.at ?? 0);
  const xOf = (at) => right - (right - left) * (end - at) / PERIOD;
  const yOf = (distance) => bottom - (bottom - top) * Math.min(1, distance);
  for (const tick of [0, 0.5, 1]) {
    stroke(board, colours.ink, 0.8, tick ? 0.15 : 0.7, (path) => addLine(path, [[left, yOf(tick)], [right, yOf(tick)]]));
    write(board, String(tick), left - 6, yOf(tick), "11px", colours.ink, null, "right");
  }
  write(board, "−60 s", left, bottom + 11, "11px", colours.ink, null, "left");
  write(board, "now", right, bottom + 11, "11px", colours.ink, null, "right");
  [colours.agent, colours.place].forEach((colour, which) => {
    stroke(board, colour, 1.8, 1, (path) => addLine(path, curves.map(({ at, distances }) =>
      [xOf(at), yOf(distances[which])])));
  });
}

/** The data of the page, which are compressed. */
async function dataOf(script) {
  const bytes = (text) => Uint8Array.from(atob(text), (byte) => byte.charCodeAt(0));
  const packed = new Blob([bytes(script.textContent)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const data = await new Response(packed).json();
  return { ...data, _wasm: { plane: bytes(data.wasm) } };
}

new Star(document.querySelector(".neorl-star"), await dataOf(document.querySelector(".star-data")));
