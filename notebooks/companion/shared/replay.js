/* The Replay in the page: recorded runs side by side, in step, in real time or `speed` times as fast.

It draws while it plays and is in view, and whenever the page changes its colours or its size. */

const MARKUP = `<div class="neorl-explorer neorl-replay"><div class="tanks"></div><div class="bar"><div class="buttons">
  <button type="button" data-action="play"></button></div>
  <label class="slide"><span>Time</span><input type="range" name="time" min="0" step="1"><output></output></label></div>
  </div>`;
const TANK = `<div class="board"><p class="title"></p><div class="arena"><canvas role="img"></canvas></div>
  <p class="legend"></p></div>`;

/** A frame of a recording in the form that `drawMovers` takes. */
function frameOf({ agent, creeps, green, radius, fineness }, at) {
  const mover = (numbers) => {
    const [x, y, vx, vy] = numbers.map((number) => number / fineness);
    return { x, y, vx, vy };
  };
  const things = creeps[at].map((each, index) => ({ ...mover(each), kind: green[at][index] ? "green" : "red" }));
  return { agent: mover(agent[at]), things, radius, body: radius, player: null, nodes: [], landings: [] };
}

class Replay {
  constructor(model, place) {
    Object.assign(this, { model, recordings: model.get("_recordings"), at: 0, owed: 0, before: null, inSight: false });
    this.seconds = this.recordings[0].seconds;
    this.speed = model.get("speed");
    this.root = elementOf(MARKUP);
    for (const { name } of this.recordings) {
      const tank = elementOf(TANK);
      tank.querySelector(".title").textContent = name;
      tank.querySelector("canvas").ariaLabel = `The tank: ${name}`;
      this.root.querySelector(".tanks").append(tank);
    }
    [this.button, this.slider] = this.root.querySelectorAll("button, input");
    this.slider.max = this.seconds.length - 1;
    this.playing = model.get("playing") && !matchMedia("(prefers-reduced-motion: reduce)").matches;
    place.append(this.root);
    this.listen();
    this.draw();
  }

  listen() {
    this.button.addEventListener("click", () => {
      if (this.isOver()) this.at = 0;
      this.play(!this.playing);
    });
    this.slider.addEventListener("input", () => {
      this.at = Number(this.slider.value);
      this.play(false);
    });
    const sight = new IntersectionObserver((entries) => {
      this.inSight = entries.at(-1).isIntersecting;
      this.play(this.playing);
    });
    sight.observe(this.root);
    const unwatch = watchLook([this.root], () => this.draw());
    this.stop = () => {
      this.playing = false;
      sight.disconnect();
      unwatch();
      this.root.remove();
    };
  }

  isOver() {
    return this.at === this.seconds.length - 1;
  }

  /** The time shown, as text: minutes and seconds if it passes faster than it was recorded. */
  time() {
    const seconds = this.seconds[this.at];
    if (this.speed === 1) return `${seconds.toFixed(1)} s`;
    return `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, "0")}, ${this.speed}×`;
  }

  play(playing) {
    this.playing = playing;
    this.before = null;
    this.draw();
    if (playing && this.inSight && !this.asked) this.ask();
  }

  ask() {
    this.asked = requestAnimationFrame((now) => {
      this.asked = null;
      if (!this.playing || !this.inSight) return;
      this.owed = this.before === null ? 0 : this.owed + this.speed * (now - this.before) / 1000;
      this.before = now;
      while (!this.isOver() && this.owed >= this.seconds[this.at + 1] - this.seconds[this.at]) {
        this.owed -= this.seconds[this.at + 1] - this.seconds[this.at];
        this.at += 1;
      }
      if (this.isOver()) this.playing = false;
      this.draw();
      if (this.playing) this.ask();
    });
  }

  draw() {
    const colours = readColours(this.root);
    const boards = this.root.querySelectorAll(".board");
    this.recordings.forEach((recording, index) => {
      const [green, red] = recording.hits[this.at];
      const score = `Score ${green - red}`.replace("-", "−");
      drawArena(boards[index].querySelector("canvas"), colours, frameOf(recording, this.at));
      boards[index].querySelector(".legend").textContent = `${score}: ${green} green, ${red} red`;
    });
    this.button.textContent = this.playing ? "Pause" : this.isOver() ? "Play again" : "Play";
    this.slider.value = this.at;
    this.root.querySelector("output").textContent = this.time();
    Object.assign(this.root.dataset, { state: this.playing ? "playing" : "paused", frame: this.at });
  }
}

function render({ model, el }) {
  const replay = new Replay(model, el);
  return () => replay.stop();
}

export default { render };
