/* Drawings of moving bodies and things in the tank, and of the agent's desires. */

// Of what is met, whose kinds may be any text.
const COLOUR_OF = new Map(Object.entries({ green: "green", target: "green", red: "red", obstacle: "red",
  vessel: "red" }));
const PAYS = new Map(Object.entries({ green: 1, red: -1, target: 1, obstacle: -1 }));

function drawMovers(board, frame) {
  const { agent, things, player, nodes, landings, radius, body, heading, hidden, wants } = frame;
  const { colours, unit } = board;
  const movers = [...things, ...(player ? [player] : []), agent];
  stroke(board, colours.ink, 1.4, 0.8, (path) => {
    for (const { x, y, vx, vy } of movers.filter((each) => Math.hypot(each.vx, each.vy) > 0.02)) {
      const drawn = HALF_A_SECOND * roomFor(x, y, HALF_A_SECOND * vx, HALF_A_SECOND * vy);
      addArrow(path, unit, x, y, drawn * vx, drawn * vy, 6);
    }
  });
  for (const thing of things) drawThing(board, thing, radius, wants);
  if (hidden) drawHidden(board, hidden);
  if (heading) drawHull(board, agent, heading, body, colours.agent);
  else drawDisc(board, agent, body, colours.agent, "");
  if (player) {
    drawDisc(board, player, body, colours.ink, "");
    drawDisc(board, player, 0.78 * body, colours.paper, "Y", colours.ink);
  }
  nodes.forEach((node, index) => drawDesire(board, agent, node, index));
  const isElsewhere = ({ x, y }) => Math.hypot(x - agent.x, y - agent.y) > body;
  for (const landing of landings.filter(isElsewhere)) drawLanding(board, landing);
}

/** Draw elements of interest that another tank's reader has dropped. */
function drawElements(board, elements) {
  for (const { x, y, valence } of elements) {
    const [colour, sign] = worthOf(board, valence);
    board.context.setLineDash([3, 3]);
    stroke(board, colour, 2, 1, (path) => path.arc(x * board.unit, y * board.unit, 16, 0, FULL_TURN));
    board.context.setLineDash([]);
    write(board, sign, x * board.unit, y * board.unit, "bold 16px", colour, board.colours.paper);
  }
}

/** The sign of a kind of thing: of what the agent wants of it, or else of what it pays. */
function signOf(kind, wants = []) {
  const valence = wants.find((each) => each.kind === kind)?.valence ?? PAYS.get(kind);
  return valence > 0 ? "+" : valence < 0 ? "−" : "";
}

/** Draw a thing with its sign, a vessel on its course, or a place with its extent. */
function drawThing(board, thing, radius, wants) {
  const { colours, unit } = board;
  if (thing.kind === "vessel") return drawHull(board, thing, [thing.vx, thing.vy], 0.7 * radius, colours.red);
  if (PAYS.has(thing.kind)) {
    return drawDisc(board, thing, radius, colours[COLOUR_OF.get(thing.kind)], signOf(thing.kind, wants));
  }
  const addPlace = (path) => path.arc(thing.x * unit, thing.y * unit, radius * unit, 0, FULL_TURN);
  fillPath(board, colours.place, 0.35, addPlace);
  stroke(board, colours.place, 2, 1, addPlace);
}

/** Draw a vessel as a wedge that points along its heading. */
function drawHull(board, { x, y }, [east, south], size, colour) {
  const length = Math.hypot(east, south) || 1;
  const [dx, dy] = [(size * east) / length, (size * south) / length];
  const corners = [[1.2, 0], [0.2, 0.6], [-0.9, 0.5], [-0.9, -0.5], [0.2, -0.6]];
  const addHull = (path) => {
    addLine(path, corners.map(([ahead, aside]) =>
      [(x + ahead * dx - aside * dy) * board.unit, (y + ahead * dy + aside * dx) * board.unit]));
    path.closePath();
  };
  fillPath(board, colour, 1, addHull);
  stroke(board, board.colours.paper, 1, 1, addHull);
}

/** Draw a hidden platform. */
function drawHidden(board, { x, y, radius }) {
  board.context.setLineDash([4, 4]);
  stroke(board, board.colours.ink, 1.6, 0.9, (path) =>
    path.arc(x * board.unit, y * board.unit, radius * board.unit, 0, FULL_TURN));
  board.context.setLineDash([]);
}

/** Draw the direction of the current, in a corner of the board. */
function drawCurrent(board, [east, south]) {
  const strength = Math.hypot(east, south);
  if (!strength) return;
  const [dx, dy] = [(0.08 * east) / strength, (0.08 * south) / strength];
  stroke(board, board.colours.place, 2.4, 1, (path) =>
    addArrow(path, board.unit, 0.09 - dx / 2, 0.06 - dy / 2, dx, dy, 8));
  write(board, "current", 0.09 * board.unit, 0.095 * board.unit, "11px", board.colours.ink, board.colours.paper);
}

/** Draw an arm in its workspace, the plane. frame: from the engine. */
function drawLimb(canvas, colours, { arm: { links, points, radius }, wants }) {
  const context = fittedContext(canvas);
  const unit = Math.min(canvas.clientWidth, canvas.clientHeight) / 2.3;
  context.translate(canvas.clientWidth / 2, canvas.clientHeight / 2);
  const board = { context, unit, colours };
  stroke(board, colours.ink, 1, 0.4, (path) => path.arc(0, 0, unit, 0, FULL_TURN));
  for (const point of points) {
    const [colour, sign] = [colours[COLOUR_OF.get(point.kind)], signOf(point.kind, wants)];
    fillPath(board, colour, 0.25, (path) => path.arc(point.x * unit, point.y * unit, radius * unit, 0, FULL_TURN));
    stroke(board, colour, 2, 1, (path) => path.arc(point.x * unit, point.y * unit, radius * unit, 0, FULL_TURN));
    write(board, sign, point.x * unit, point.y * unit, `bold ${0.09 * unit}px`, colour);
  }
  stroke(board, colours.agent, 0.03 * unit, 0.9, (path) =>
    addLine(path, [[0, 0], ...links.map(({ x, y }) => [x * unit, y * unit])]));
  for (const joint of [{ x: 0, y: 0 }, ...links]) drawDisc(board, joint, 0.05, colours.ink, "");
  drawDisc(board, links.at(-1), 0.065, colours.agent, "");
}

function drawDisc(board, { x, y }, radius, colour, sign, signColour = "#fff") {
  const { unit } = board;
  fillPath(board, colour, 1, (path) => path.arc(x * unit, y * unit, radius * unit, 0, FULL_TURN));
  write(board, sign, x * unit, y * unit, `bold ${1.4 * radius * unit}px`, signColour);
}

/** Draw a node's desire, dashed, with the node's name at its end. Long ones are shortened to stay visible. */
function drawDesire(board, agent, { name, x, y }, index) {
  const length = Math.hypot(x, y);
  const drawn = LONGEST_DESIRE * (1 - Math.exp(-2 * length));
  if (drawn < 0.05) return;
  const share = (drawn / length) * roomFor(agent.x, agent.y, (drawn * x) / length, (drawn * y) / length);
  const [dx, dy, ahead] = [share * x, share * y, 1 + 0.028 / drawn];
  board.context.setLineDash([5, 4]);
  stroke(board, board.colours.agent, 2, 1, (path) => addArrow(path, board.unit, agent.x, agent.y, dx, dy, 0));
  board.context.setLineDash([]);
  stroke(board, board.colours.agent, 2, 1, (path) => addHead(path, board.unit, agent.x + dx, agent.y + dy, dx, dy, 7));
  const aside = (index % 2 ? -1 : 1) * (0.022 / drawn); // so that the names of parallel desires do not overlap
  const [textX, textY] = [agent.x + dx * ahead - dy * aside, agent.y + dy * ahead + dx * aside].map(clampedToBoard);
  write(board, name, textX * board.unit, textY * board.unit, "600 12px", board.colours.agent, board.colours.paper);
}

/** Draw where one node's desire places an element for another: a signed diamond, at the border if outside. */
function drawLanding(board, { x, y, valence }) {
  const half = 0.028 * board.unit;
  const [left, top] = [x, y].map((place) => inSight(place) * board.unit);
  const [colour, sign] = worthOf(board, valence);
  const addDiamond = (path) => {
    path.moveTo(left, top - half);
    for (const [dx, dy] of [[half, 0], [0, half], [-half, 0]]) path.lineTo(left + dx, top + dy);
    path.closePath();
  };
  stroke(board, board.colours.paper, 3, 1, addDiamond);
  fillPath(board, colour, 1, addDiamond);
  write(board, sign, left, top, `bold ${1.3 * half}px`, "#fff");
}

function worthOf({ colours }, valence) {
  return valence < 0 ? [colours.red, "−"] : [colours.green, "+"];
}
