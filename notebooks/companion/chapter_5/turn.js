/* The Turn in the page: an agent that avoids red creeps comes to want them, with learning on or off from there.

A whole run is drawn as fast as the page computes it, beside the last one with the other setting; then the agent goes
on in the tank, at `PACE` times real time. Out of view, or paused, nothing is asked of the worker. */

const [PACE, BUDGET, MOST_SECONDS, DAY] = [4, 60, 0.1, 86_400]; // times real time, milliseconds, seconds, seconds
const MARKUP = `<div class="neorl-explorer neorl-turn"><p role="alert" hidden></p><div class="columns">
  <div class="board"><p class="minutes"></p><canvas role="img" aria-label="The tank with the agent"></canvas>
  <div class="buttons"><button type="button" data-action="play"></button><label class="tick"><input type="checkbox" checked>Learning goes on after the
  turn</label></div></div><div class="side"><p class="title">Red creeps caught a minute</p><canvas role="img"
  aria-label="Red creeps that the agent catches a minute, over the run"></canvas><p class="legend"></p>
  <p class="said" role="status"></p></div></div></div>`;
const COLOURS = { on: "agent", off: "red" }; // of the curves, by whether learning goes on

class Turn {
  constructor(model, place) {
    Object.assign(this, { model, runs: model.get("_runs"), setting: "on", run: null, before: null, inSight: false,
      isPlaying: !matchMedia("(prefers-reduced-motion: reduce)").matches });
    this.root = elementOf(MARKUP);
    [this.tank, this.reds] = this.root.querySelectorAll("canvas");
    place.append(this.root);
    [this.play, this.learns] = this.root.querySelectorAll("button, input");
    this.play.addEventListener("click", () => this.wake({ isPlaying: !this.isPlaying }));
    this.learns.addEventListener("change", () => this.wake({ setting: this.learns.checked ? "on" : "off", run: null,
      isPlaying: true, before: this.run?.isWhole ? { ...this.lineOf(this.run), isPale: true } : this.before }));
    const sight = new IntersectionObserver((entries) => this.wake({ inSight: entries.at(-1).isIntersecting }));
    sight.observe(this.root);
    const unwatch = watchLook([this.tank, this.reds], () => this.wake());
    this.stop = () => {
      for (const end of [() => sight.disconnect(), unwatch, () => this.engine?.stop()]) end();
      this.root.remove();
    };
  }

  /** Begin a run, whose agent changes at the turn, or advance it. */
  async ask(request) {
    this.engine ??= startEngine(this.model, (message) => this.fail(message));
    const { run, runs, setting } = this;
    const given = request.type === "begin" ? runs[setting] : {};
    run.isBusy = true;
    const frame = await this.engine.ask({ ...given, ...request });
    if (!frame || run !== this.run) return;
    Object.assign(run, { frame, isBusy: false, isWhole: frame.step >= run.steps });
    this.wake();
  }

  /** Draw what has changed, and go on if there is anything to do. */
  wake(changed = {}) {
    Object.assign(this, changed);
    this.asked ??= requestAnimationFrame(guarded((now) => this.tick(now), (message) => this.fail(message)));
  }

  async tick(now) {
    this.asked = null;
    const isRunning = this.isPlaying && this.inSight && this.root.isConnected;
    const elapsed = Math.min((now - (this.last ?? now)) / 1000, MOST_SECONDS);
    this.last = isRunning ? now : null;
    this.draw();
    if (!isRunning || this.run?.isBusy) return;
    const { steps, world: { fps } } = this.runs[this.setting];
    const { frame, isWhole } = this.run ??= { steps, fps, frame: null, isWhole: false };
    const begin = { type: "begin", run: 0, steps: steps + DAY * fps, bin_steps: 60 * fps, map: "", field: 0, heat: 0 };
    if (!frame) await this.ask(begin);
    else if (!isWhole) await this.ask({ type: "advance", steps: steps - frame.step, budget: BUDGET });
    else await this.ask({ type: "advance", steps: Math.round(PACE * elapsed * fps), budget: Infinity });
  }

  /** The red creeps that a run has caught, minute by minute, and how much of it there is to draw. */
  lineOf({ frame, steps, fps }) {
    const { counts } = frame.hits.find(({ kind }) => kind === "red");
    const span = { seconds: steps / fps, binSeconds: 60, elapsed: Math.min(frame.step, steps) / fps };
    return { totals: counts, colour: COLOURS[this.setting], per: 60, span, setting: this.setting };
  }

  draw() {
    const { root, run, before, isPlaying } = this;
    const part = (name) => root.querySelector(name);
    this.play.textContent = isPlaying ? "Pause" : "Play";
    root.dataset.state = run?.isWhole ? "whole" : run?.frame ? "running" : "waiting";
    if (!run?.frame) return;
    const [colours, line, { frame, fps, steps, isWhole }] = [readColours(root), this.lineOf(run), run];
    const [turn, end] = [this.runs[this.setting].changes[0].step, steps].map((step) => step / fps);
    drawArena(this.tank, colours, { ...frame, seen: null, nodes: [], landings: [] }, { trail: true });
    const [span, lines] = [{ ...line.span, mark: { second: turn, text: "red becomes good" } }, [line, before]];
    drawCurves(this.reds, colours, span, lines.filter(Boolean).reverse());
    part(".legend").replaceChildren(...lines.filter(Boolean).flatMap(({ colour, setting: learning, isPale }, at) => [
      at ? " · " : "", element("span", { className: "swatch", style: `border-top: 2px solid var(--${colour})` }),
      `learning ${learning}${isPale ? ", the run before" : " after the turn"}`]));
    const wanted = frame.wants.some(({ kind, valence }) => kind === "red" && valence > 0) ? "wanted" : "avoided";
    part(".minutes").textContent = `${counted(Math.floor(frame.step / fps / 60), "minute")} · red is ${wanted}`;
    const mean = (from, to) =>
      (line.totals.slice(from, to).reduce((sum, each) => sum + each, 0) / (to - from)).toFixed(1);
    const [quarter, half, late, last] = [0.5 * turn, turn, (turn + end) / 2, end].map((at) => Math.floor(at / 60));
    part(".said").textContent = isWhole && quarter ? `Red creeps a minute: ${mean(quarter, half)} before the turn, `
      + `${mean(half, half + 1)} in the minute after it, ${mean(late, last)} in the last ${counted(last - late, "minute")}.` : "";
    if (isWhole) root.dataset.caught = line.totals.join(" ");
  }

  fail(message = "The agent has stopped. Reload the page to begin again.") {
    this.engine?.stop();
    Object.assign(this, { engine: null, run: null, isPlaying: false });
    Object.assign(this.root.querySelector("[role=alert]"), { hidden: false, textContent: message });
  }
}

function render({ model, el }) {
  const begin = () => (isCompiling(model) ? waitIn(el, model) : new Turn(model, el).stop);
  let stop = begin();
  model.on("change:_wasm", () => {
    stop();
    stop = begin();
  });
  return () => stop();
}

export default { render };
