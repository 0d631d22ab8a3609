/* The Steering in the page: walkers go to a goal that the reader drags, by desire vectors that an agent has learned. */

const FINENESS = 1000; // positions of the recording are integers, in this fraction of the box
const NUDGE = 0.02; // of an arrow key
const ARROWS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowRight: [1, 0], ArrowLeft: [-1, 0] };
const MARKUP = `<div class="neorl-explorer neorl-steering"><div class="arena"><canvas role="img"
  aria-label="A box with the path of a rat, and ways to a goal"></canvas><button type="button" class="interest chosen"
  aria-label="The goal. Drag it, or move it by arrow keys."></button></div><p class="said" role="status"></p></div>`;

const floatsOf = ({ buffer, byteOffset, byteLength }) => new Float32Array(
  buffer.slice(byteOffset, byteOffset + byteLength));
const inOne = (number) => Math.max(-1, Math.min(1, number));

function addCross(path, x, y) {
  for (const side of [-5, 5]) {
    path.moveTo(x - side, y - 5);
    path.lineTo(x + side, y + 5);
  }
}

class Steering {
  constructor(model, place) {
    const { noise, ...walk } = model.get("_walk");
    Object.assign(this, walk, { noise: floatsOf(noise), watched: model.get("_watched") });
    this.maps = model.get("_maps").map(({ side, vectors }) => ({ side, vectors: floatsOf(vectors) }));
    this.root = elementOf(MARKUP);
    [this.arena, this.canvas, this.mark, this.said] = this.root.querySelectorAll(".arena, canvas, button, .said");
    place.append(this.root);
    this.mark.addEventListener("pointerdown", ({ pointerId }) => this.mark.setPointerCapture(pointerId));
    this.mark.addEventListener("pointermove", (event) => {
      if (this.mark.hasPointerCapture(event.pointerId)) this.aim(this.placeOf(event));
    });
    this.canvas.addEventListener("click", (event) => this.aim(this.placeOf(event)));
    this.mark.addEventListener("keydown", (event) => {
      if (!ARROWS[event.key]) return;
      event.preventDefault();
      this.aim(this.goal.map((from, along) => from + NUDGE * ARROWS[event.key][along]));
    });
    const unwatch = watchLook([this.canvas], () => this.draw());
    this.stop = () => [unwatch, () => this.root.remove()].forEach((end) => end());
    this.aim(this.goal);
  }

  placeOf({ clientX, clientY }) {
    const { left, top, width } = this.arena.getBoundingClientRect();
    return [clientX - left, clientY - top].map((offset) => placeAt(offset / width));
  }

  aim(goal) {
    this.goal = goal.map(clampedToBoard);
    this.ways = this.starts.map((start, index) => this.walk(start, index));
    this.draw();
  }

  /** The scaled sum of the maps' vectors in a place; no number differs from 0 where the agent knows no way. */
  push(place) {
    const sum = [0, 0];
    for (const { side, vectors } of this.maps) {
      const [cell, goal] = [place, this.goal].map((where) => {
        const [column, row] = where.map((each) => Math.min(side - 1, Math.floor(each * side)));
        return column + side * row;
      });
      for (const along of [0, 1]) sum[along] += vectors[2 * (cell * side ** 2 + goal) + along];
    }
    const longest = Math.max(...sum.map(Math.abs));
    return longest > 0 ? sum.map((each) => each / longest) : sum;
  }

  /** The way of a walker, as `companion.recordings.ways.walk` walks it. */
  walk(start, index) {
    const { noise, step, near, sway, clear, goal, starts } = this;
    const steps = noise.length / (2 * starts.length);
    const drawn = (at) => [0, 1].map((along) => noise[2 * (index * steps + at) + along]);
    let [place, ahead] = [start, drawn(0)];
    const [way, distance] = [[place], () => Math.hypot(...place.map((each, along) => each - goal[along]))];
    for (let at = 0; at < steps && distance() > near; at += 1) {
      const pushed = this.push(place);
      ahead = (pushed.some(Boolean) ? pushed : ahead).map((each, along) => inOne(each + sway * drawn(at)[along]));
      const [right, down] = ahead.map((each) => step * each);
      const isFree = (part) => part.some(Boolean) && part.every((each, along) =>
        place[along] + clear * each > 0 && place[along] + clear * each < 1);
      const part = [[right, down], [right, 0], [0, down]].find(isFree) ?? [0, 0];
      place = place.map((each, along) => each + part[along]);
      way.push(place);
    }
    return { way, arrived: distance() <= near };
  }

  draw() {
    const { root, arena, canvas, mark, said, ways, goal, watched } = this;
    const [colours, context] = [readColours(root), fittedContext(canvas)];
    const unit = canvas.clientWidth / (1 + 2 * BOARD_MARGIN);
    context.translate(BOARD_MARGIN * unit, BOARD_MARGIN * unit);
    const board = { context, unit, colours };
    stroke(board, colours.agent, 0.7, 0.45, (path) => watched.forEach((place, at) => {
      if (place) path[watched[at - 1] ? "lineTo" : "moveTo"](...place.map((each) => each / FINENESS * unit));
    }));
    stroke(board, colours.ink, 1.4, 0.75, (path) => path.rect(0, 0, unit, unit));
    for (const { way, arrived } of ways) {
      const scaled = way.map((place) => place.map((each) => each * unit));
      const colour = arrived ? colours.green : colours.red;
      stroke(board, colour, 2.2, 1, (path) => addLine(path, scaled));
      fillPath(board, colour, 1, (path) => path.arc(...scaled[0], 4, 0, FULL_TURN));
      if (!arrived) stroke(board, colours.ink, 2.4, 1, (path) => addCross(path, ...scaled.at(-1)));
    }
    ["left", "top"].forEach((side, along) => { mark.style[side] = `${100 * shareOf(goal[along])}%`; });
    const arrived = ways.filter((each) => each.arrived).length;
    const there = goal.map((each) => each.toFixed(2)).join(", ");
    said.textContent = `${arrived} of ${ways.length} ways arrive at (${there}).`;
    const steps = ways.map(({ way }) => way.length - 1);
    Object.assign(root.dataset, { goal: goal.join(" "), steps: steps.join(" ") });
  }
}

export default { render: ({ model, el }) => new Steering(model, el).stop };
