/* The Changes in the page: equation 4.8, one change of cell after the other, as an agent has made them. For each
picture, everything is learned again, so it follows from the number of changes, the discount and the goal alone. */

const ACTIONS = ["north", "south", "east", "west"];
const ARROWS = { ArrowUp: [0, -1], ArrowDown: [0, 1], ArrowRight: [1, 0], ArrowLeft: [-1, 0] };
const MARKUP = `<div class="neorl-explorer neorl-changes"><div class="columns"><div class="board">
  <p class="minutes"></p><canvas tabindex="0" role="application"
  aria-label="The map. Arrow keys choose another goal."></canvas></div><div class="side"><div class="buttons">
  ${[["Next change of cell", 1], ["100 more", 100], ["All", Infinity], ["Begin again", -Infinity]].map(([text, more]) =>
    `<button type="button" data-more="${more}">${text}</button>`).join("")}</div><label class="slide"><span>Discount γ
  </span><input type="range" min="0" max="0.99" step="0.01"><output></output></label><table><caption></caption><thead>
  <tr>${["Push", "ψ", "Old value", "Target", "New value"].map((text) => `<th scope="col">${text}</th>`).join("")}</tr>
  </thead><tbody></tbody></table><p class="legend"></p></div></div></div>`;

class Changes {
  constructor(model, place) {
    const { changes, side, discount } = model.get("_run");
    Object.assign(this, { ...model.get("_run"), made: 0, goal: changes[0][1], at: (cell) =>
      [cell % side, Math.floor(cell / side)] }); // a cell's column and row, from 0
    this.root = elementOf(MARKUP);
    [this.map, this.slider] = this.root.querySelectorAll("canvas, input");
    this.slider.value = discount;
    place.append(this.root);
    this.root.addEventListener("click", ({ target: { dataset: { more } } }) => more && this.show({
      made: Math.max(0, Math.min(changes.length, this.made + Number(more))) }));
    this.slider.addEventListener("input", () => this.show({ discount: Number(this.slider.value) }));
    this.map.addEventListener("click", ({ offsetX, offsetY }) => {
      const [x, y] = [offsetX, offsetY].map((pixel) => Math.min(side - 1,
        Math.floor(side * clampedToBoard(placeAt(pixel / this.map.clientWidth)))));
      this.show({ goal: x + side * y });
    });
    this.map.addEventListener("keydown", (event) => {
      const [x, y] = this.at(this.goal).map((from, along) => from + (ARROWS[event.key]?.[along] ?? side));
      if (Math.min(x, y) < 0 || Math.max(x, y) >= side) return;
      event.preventDefault();
      this.show({ goal: x + side * y });
    });
    const unwatch = watchLook([this.map], () => this.draw());
    this.stop = () => [unwatch, () => this.root.remove()].forEach((end) => end());
    this.show({});
  }

  /** Learn from all changes made so far, with the present discount. */
  show(chosen) {
    Object.assign(this, chosen);
    const cells = this.side ** 2;
    this.q = new Float32Array(cells * ACTIONS.length * cells); // of each cell, action and goal
    for (const change of this.changes.slice(0, this.made)) this.learn(change);
    this.draw();
  }

  /** Equations 4.7 and 4.8. change: [cell left, cell entered, steps in the cell left, …how many had each action]. */
  learn([left, entered, steps, ...counts]) {
    const { q, rate, discount, goal: shown, side } = this;
    this.rows = counts.map((count, action) => ({ action, credit: count / steps }));
    for (let goal = 0; goal < side ** 2; goal += 1) {
      const target = goal === entered ? 1 : discount * this.best(entered, goal);
      for (const row of this.rows) {
        const at = this.place(left, row.action, goal);
        const before = q[at];
        q[at] += row.credit * rate * (target - before);
        if (goal === shown) Object.assign(row, { before, target, after: q[at] });
      }
    }
  }

  place(cell, action, goal) {
    return (cell * ACTIONS.length + action) * this.side ** 2 + goal;
  }

  best(cell, goal) {
    return Math.max(...ACTIONS.map((_, action) => this.q[this.place(cell, action, goal)]));
  }

  draw() {
    const { root, map, side, goal, made, changes, q } = this;
    const [part, colours, context] = [(name) => root.querySelector(name), readColours(root), fittedContext(map)];
    const unit = map.clientWidth / (1 + 2 * BOARD_MARGIN);
    const [board, half] = [{ context, unit, colours }, 0.5 / side];
    context.translate(BOARD_MARGIN * unit, BOARD_MARGIN * unit);
    const [x, y] = [0, 1].map((along) => (cell) => this.at(cell)[along] / side + half); // of a cell's middle
    const square = (cell, inset = 0) => (path) => path.rect(...[x, y].map((middle) =>
      (middle(cell) - half + inset) * unit), ...Array(2).fill(2 * (half - inset) * unit));
    const cells = Array.from({ length: side ** 2 }, (_, cell) => cell);
    for (const cell of cells) {
      const value = cell === goal ? 0 : this.best(cell, goal);
      fillPath(board, colours.green, 0.75 * Math.sqrt(value), square(cell));
      stroke(board, colours.ink, 0.8, 0.3, square(cell));
      if (value >= 0.005) write(board, value.toFixed(2), x(cell) * unit, (y(cell) + 0.66 * half) * unit, "11px", colours.ink);
    }
    const valueOf = (cell, action) => (cell === goal ? 0 : q[this.place(cell, action, goal)]);
    drawVectors(board, colours.ink, 1.4, 0.8, cells.flatMap((cell) => [[2, 3], [1, 0]].map(([one, other]) =>
      valueOf(cell, one) - valueOf(cell, other))), (cell) => ({ x: x(cell), y: y(cell), size: 1.2 * half }));
    fillPath(board, colours.goal, 0.25, square(goal));
    const [left, entered] = changes[made - 1] ?? [];
    for (const cell of made ? [left, entered] : []) stroke(board, colours.agent, 2.4, 1, square(cell, 0.015));
    const nameOf = (cell) => this.at(cell).map((each, along) => `${["column", "row"][along]} ${each + 1}`).join(", ");
    part(".minutes").textContent = `${[made, changes.length].map((each) => each.toLocaleString("en-GB")).join(" of ")}
      changes of cell`;
    part("output").value = this.discount.toFixed(2);
    part("caption").textContent = made ? `From ${nameOf(left)} to ${nameOf(entered)}` : "Nothing learned yet";
    part("tbody").replaceChildren(...(made ? this.rows : []).map(({ action, credit, before, target, after }) =>
      element("tr", {}, element("th", { scope: "row" }, ACTIONS[action]),
        ...[credit, before, target, after].map((value) => element("td", {}, value.toFixed(3))))));
    part(".legend").textContent = `Goal: ${nameOf(goal)}. Its value function is drawn: another is a click away.`;
    Object.assign(root.dataset, { made, goal, sum: q.reduce((sum, value) => sum + value, 0) });
  }
}

export default { render: ({ model, el }) => new Changes(model, el).stop };
