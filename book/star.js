/* The star in the page: an agent with 100 minutes of experience, one without, and a star to drag.

- The rules are those of star.py. Each agent has a worker of its own, which advances only on request. The lesson, and
  every request, is short, so that the page stays responsive; out of view, or paused, none is made.
- `runs` holds all that the page knows of the two runs, and is replaced as a whole; answers to requests of earlier
  ones are dropped. What is shown is measured in the frames of the two runs, weighted by time.
- While red is good there is no star, which would keep the agent from red discs. */

const SPEED = 2; // times real time, as the caption of the table says
const [LESSON_BUDGET, MOST_SECONDS] = [24, 0.1]; // milliseconds of each request; simulated seconds behind real time
const [LESSON_BINS, ENOUGH] = [10, 10]; // in which the lesson counts discs; seconds after which a rate is shown
const [GREEN, RED, MOST_REDS] = [0, 1, 100]; // the kinds of discs; the height of the curve
const [PERIOD, CALM, NUMBERS] = [60, 500, 250]; // seconds measured; milliseconds between drawings, and between numbers
const [STEP, EDGE] = [0.04, 0.03]; // of the arrow keys, and the star's distance to the walls, in board widths
const DAY = 86_400; // seconds, after which a run begins again
const ARROWS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowRight: [1, 0], ArrowLeft: [-1, 0] };
const STOPPED = "The agents have stopped. Reload the page to begin again.";

class Star {
  constructor(root, data) {
    Object.assign(this, { root, data, star: data.star, forgetful: false, redIsGood: false, runs: null, engines: [],
      isPlaying: !matchMedia("(prefers-reduced-motion: reduce)").matches, inSight: false, drawn: 0, numbered: 0 });
    this.calm = !this.isPlaying;
    [this.tank, this.other, this.curve] = root.querySelectorAll("canvas");
    this.handle = root.querySelector(".star");
    this.listen();
  }

  listen() {
    const { root, handle, tank } = this;
    const on = (target, type, act) => target.addEventListener(type, this.safely(act));
    on(root.querySelector(".buttons"), "click", ({ target }) => this.press(target.dataset.action));
    on(handle, "pointerdown", ({ pointerId }) => handle.setPointerCapture(pointerId));
    on(handle, "pointermove", (event) => handle.hasPointerCapture(event.pointerId) && this.move(this.placeOf(event)));
    on(tank, "click", (event) => !this.handle.hidden && this.move(this.placeOf(event)));
    on(handle, "keydown", (event) => {
      const [x, y] = ARROWS[event.key] ?? [];
      if (x === undefined) return;
      event.preventDefault();
      this.move({ x: this.star.x + STEP * x, y: this.star.y + STEP * y });
    });
    watchLook([tank, this.other, this.curve], () => this.wake());
    new IntersectionObserver(this.safely((entries) => {
      this.inSight = entries.at(-1).isIntersecting;
      if (this.inSight && !this.runs) return this.begin();
      return this.wake();
    })).observe(root);
  }

  placeOf({ clientX, clientY }) {
    const { left, top, width, height } = this.tank.getBoundingClientRect();
    return { x: placeAt((clientX - left) / width), y: placeAt((clientY - top) / height) };
  }

  press(action) {
    if (action === "play") this.isPlaying = !this.isPlaying;
    if (action === "forget") this.forgetful = !this.forgetful, this.begin();
    if (action === "red") this.redIsGood = !this.redIsGood, this.runs.curves = [], this.change();
    this.wake();
  }

  /** Let both agents want something else, and begin to measure again. */
  change() {
    Object.assign(this.runs, { isChanged: true, past: [] });
    this.root.dataset.seconds = 0;
  }

  move(place) {
    const [x, y] = [place.x, place.y].map((side) => Math.min(1 - EDGE, Math.max(EDGE, side)));
    Object.assign(this, { star: { x, y } });
    this.change();
    this.wake();
  }

  /** The parameters of an agent that learns no more, and wants the star, or red discs. */
  parameters() {
    const { data: { valence, red }, star, redIsGood } = this;
    const parameters = structuredClone(this.data.parameters);
    parameters.learning.learning_rate = 0;
    for (const e of red) parameters.desires[e].valence = redIsGood ? 1 : -1;
    if (redIsGood) return parameters;
    const source = this.data._layout.plane.enumerations.Source.place;
    parameters.names.forEach((_, n) => addElement(parameters, n, source, { ...star, valence }));
    return parameters;
  }

  // The two runs

  /** Begin both runs, after the first agent's lesson unless it is to know nothing. */
  async begin() {
    const { data: { world, seed, lesson, parameters: learning }, forgetful } = this;
    const runs = this.runs = newRuns();
    if (!this.engines.length) {
      const model = { get: (name) => this.data[name] };
      this.engines = [0, 1].map(() => startEngine(model, (message) => this.fail(message)));
    }
    const steps = DAY * world.fps;
    const common = { type: "begin", world, seed, run: 0, steps, bin_steps: steps, map: "", heat: 0, field: 0 };
    this.show("learning", 0);
    const parameters = this.parameters(); // the star may be moved in the meantime, which is a change
    runs.frames[1] = await this.ask({ ...common, parameters }, 1);
    if (runs !== this.runs) return;
    if (!forgetful) {
      const bin = lesson / LESSON_BINS;
      await this.ask({ ...common, parameters: learning, seed: seed + 1, steps: lesson, bin_steps: bin });
      for (let frame = {}; !frame.ended;) {
        frame = runs.frames[0] = await this.ask({ type: "advance", steps: lesson, budget: LESSON_BUDGET });
        if (runs !== this.runs) return;
        this.show("learning", minutesOf(frame.step, world));
        if (!this.calm) this.draw();
      }
      runs.reds = runs.frames[0].hits[RED].counts.at(-1) / minutesOf(bin, world);
    }
    // An agent that forgets has another run, or the two would be the same to the last bit.
    const own = { run: Number(forgetful), keeps: !forgetful, field: FIELD_TILES };
    const frame = await this.ask({ ...common, ...own, parameters });
    if (runs !== this.runs) return;
    Object.assign(runs, { frames: [frame, runs.frames[1]], haveBegun: true });
    this.show("paused");
    this.wake();
  }

  ask(request, engine = 0) {
    return this.engines[engine].ask(request);
  }

  isRunning() {
    return this.isPlaying && this.inSight && Boolean(this.runs?.haveBegun);
  }

  async advance(steps) {
    const { runs } = this;
    runs.isBusy = true;
    if (runs.isChanged) {
      runs.isChanged = false;
      const change = { type: "change", parameters: this.parameters() };
      const frames = await Promise.all([this.ask(change), this.ask(change, 1)]);
      if (runs !== this.runs) return;
      runs.frames = frames;
    }
    if (steps) {
      const request = { type: "advance", steps, budget: Infinity };
      runs.frames = await Promise.all([this.ask(request), this.ask(request, 1)]);
      if (runs !== this.runs) return;
      this.measure(runs);
      if (runs.frames[0].ended) await this.begin();
    }
    runs.isBusy = false;
    this.wake();
  }

  /** Keep the distances and the captures of the last minute. */
  measure(runs) {
    const sample = this.sample(runs.frames);
    const isRecent = ({ at }) => sample.at - at <= PERIOD;
    runs.past = [...runs.past, sample].filter(isRecent);
    runs.curves = [...runs.curves, sample].filter(isRecent);
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
    const { runs, data: { world: { fps } } } = this;
    this.asked = null;
    const elapsed = Math.min((now - (this.before ?? now)) / 1000, MOST_SECONDS);
    this.before = this.isRunning() ? now : null;
    if (runs?.haveBegun) {
      if (this.isRunning()) {
        this.show("running");
        runs.owed = Math.min(runs.owed + SPEED * elapsed * fps, SPEED * MOST_SECONDS * fps);
        this.wake();
      } else this.show("paused");
      const steps = this.isRunning() ? Math.floor(runs.owed) : 0;
      if (!runs.isBusy && (steps || runs.isChanged)) runs.owed -= steps, this.safely(() => this.advance(steps))();
    }
    if (!this.calm || !this.isRunning() || now - this.drawn >= CALM) this.draw(now);
  }

  show(state, minutes = 0) {
    const { root, forgetful, isPlaying, redIsGood, data: { lesson, world } } = this;
    const whole = counted(minutesOf(lesson, world), "minute");
    const said = { learning: `It learns for ${whole}, without a star: ${Math.floor(minutes)} …`,
      failed: "" }[state] ?? [forgetful ? "It has forgotten everything" : `It learned for ${whole}`,
      redIsGood ? "The star is gone." : "It learns no more."].join(". ");
    root.querySelector(".minutes").textContent = said;
    if (root.dataset.state !== state) {
      root.dataset.state = state;
      root.querySelector("[role=status]").textContent = state === "learning" ? "" : said;
    }
    this.handle.hidden = redIsGood || !["learning", "running", "paused"].includes(state);
    this.placeStar();
    root.querySelector("[data-action=play]").textContent = isPlaying ? "Pause" : "Play";
    for (const [action, pressed] of [["forget", forgetful], ["red", redIsGood]]) {
      root.querySelector(`[data-action=${action}]`).ariaPressed = pressed;
    }
  }

  placeStar() {
    const { handle, star } = this;
    handle.style.left = `${100 * shareOf(star.x)}%`;
    handle.style.top = `${100 * shareOf(star.y)}%`;
    const [across, down] = [star.x, star.y].map((side) => Math.round(100 * side));
    handle.ariaLabel = `The star, ${across} % from the left and ${down} % from the top: drag it, or use the arrow keys.`;
  }

  draw(now = performance.now()) {
    const { root, tank, other, runs } = this;
    this.drawn = now;
    if (!runs) return;
    const colours = readColours(root);
    const [mine, theirs] = runs.frames;
    if (mine) drawArena(tank, colours, bare(mine), { trail: runs.haveBegun });
    if (theirs) drawArena(other, { ...colours, agent: colours.place }, bare(theirs), { trail: runs.haveBegun });
    if (theirs && !this.redIsGood) this.drawStar(other, colours);
    this.placeStar();
    if (runs.haveBegun && (now - this.numbered >= NUMBERS || !this.isRunning())) this.showNumbers(colours, now);
  }

  drawStar(canvas, colours) {
    const unit = canvas.clientWidth / (1 + 2 * BOARD_MARGIN);
    write({ context: canvas.getContext("2d"), colours }, "★", this.star.x * unit, this.star.y * unit, "20px",
      colours.goal, colours.paper);
  }

  /** Write the numbers of the last minute, or of the time since the last change, and draw the curves. */
  showNumbers(colours, now) {
    const { root, curve, redIsGood, runs: { past, curves, frames, reds } } = this;
    this.numbered = now;
    const [first, last] = past.length ? [past[0], past.at(-1)] : [this.sample(frames), this.sample(frames)];
    const seconds = last.at - first.at;
    root.querySelector(".period").textContent = `The last ${counted(Math.round(seconds), "simulated second")}, at twice the pace`;
    root.querySelectorAll("[data-measures]").forEach((title) => {
      title.hidden = title.dataset.measures !== (redIsGood ? "red" : "distance");
    });
    root.querySelectorAll("tbody tr").forEach(({ cells }, which) => {
      const sum = past.slice(1).reduce((total, { at, distances }, before) =>
        total + (at - past[before].at) * distances[which], 0);
      const near = seconds ? (sum / seconds).toFixed(2) : "–";
      const before = which === 0 && reds !== null ? Math.round(reds) : "–";
      const caught = [GREEN, RED].map((kind) => seconds < ENOUGH ? "–"
        : Math.round(60 / seconds * (last.hits[which][kind] - first.hits[which][kind])));
      [redIsGood ? before : near, ...caught].forEach((number, column) => {
        cells[column + 1].textContent = number;
      });
    });
    const sinceFirst = ({ hits }, which) => (hits[which][RED] - curves[0].hits[which][RED]) / MOST_REDS;
    drawShares(curve, colours, curves, redIsGood ? sinceFirst : ({ distances }, which) => distances[which],
      redIsGood ? MOST_REDS : 1);
    Object.assign(root.dataset, { step: frames[0].step, seconds: Math.round(seconds),
      at: [frames[0].agent.x, frames[0].agent.y].join(" ") });
  }

  // Failures

  safely(act) {
    return guarded(act, (message) => this.fail(message));
  }

  fail(message = STOPPED) {
    for (const engine of this.engines) engine.stop();
    Object.assign(this, { engines: [], runs: newRuns() });
    this.show("failed");
    Object.assign(this.root.querySelector("[role=alert]"), { hidden: false, textContent: message });
  }
}

/** reds: that the agent caught in a minute at the end of its lesson. */
const newRuns = () => ({ frames: [], haveBegun: false, reds: null, past: [], curves: [], owed: 0, isChanged: true,
  isBusy: false });

/** A frame without maps and desires. */
const bare = (frame) => ({ ...frame, seen: null, nodes: [], landings: [] });

const minutesOf = (steps, { fps }) => steps / fps / 60;

/** Draw, for both agents, shares of `most` over the last minute. */
function drawShares(canvas, colours, samples, shareIn, most) {
  const board = { context: fittedContext(canvas), colours };
  const [left, top, right, bottom] = [30, 8, canvas.clientWidth - 4, canvas.clientHeight - 18];
  const end = Math.max(PERIOD, samples.at(-1)?.at ?? 0);
  const xOf = (at) => right - (right - left) * (end - at) / PERIOD;
  const yOf = (share) => bottom - (bottom - top) * Math.min(1, share);
  for (const tick of [0, 0.5, 1]) {
    stroke(board, colours.ink, 0.8, tick ? 0.15 : 0.7, (path) => addLine(path, [[left, yOf(tick)], [right, yOf(tick)]]));
    write(board, String(tick * most), left - 6, yOf(tick), "11px", colours.ink, null, "right");
  }
  write(board, "−60 s", left, bottom + 11, "11px", colours.ink, null, "left");
  write(board, "now", right, bottom + 11, "11px", colours.ink, null, "right");
  [colours.agent, colours.place].forEach((colour, which) => {
    stroke(board, colour, 1.8, 1, (path) => addLine(path, samples.map((sample) =>
      [xOf(sample.at), yOf(shareIn(sample, which))])));
  });
}

/** The data of the page, which are compressed. */
async function dataOf(script) {
  const bytes = (text) => Uint8Array.from(atob(text), (byte) => byte.charCodeAt(0));
  const packed = new Blob([bytes(script.textContent)]).stream().pipeThrough(new DecompressionStream("gzip"));
  const data = await new Response(packed).json();
  return { ...data, _wasm: { plane: bytes(data.wasm) } };
}

const data = await dataOf(document.querySelector(".star-data"));
new Star(document.querySelector(".neorl-star"), data);
