/* Drawings of the Explorer: the world, on a canvas of its own.

A drawing keeps no state, and depends only on its arguments. Places are in units of the world's size, y downward, as in
the frames of the engine. Positions are not clipped, so discs may overlap the border of the tank, as in the figures of
the book. Colours come from the style sheet, which takes them from the page. They are read for each drawing and never
kept, because a host may render a widget before it is part of the page, where it has neither colours nor a size. */

const [BOARD_MARGIN, LONGEST_DESIRE, BEYOND] = [0.055, 0.3, 3]; // in board widths; no drawing reaches BEYOND
const [HALF_A_SECOND, FULL_TURN] = [0.5, 2 * Math.PI]; // a velocity is drawn as the distance covered in half a second
const FIELD_TILES = 15; // along each side, for the superposed value

/** The colours and the font that the style sheet gives the widget on this page. */
function readColours(root) {
  const style = getComputedStyle(root);
  const valueOf = (name) => [name, style.getPropertyValue(`--${name}`).trim()];
  const names = ["ink", "paper", "agent", "green", "red", "place", "goal"];
  return { ...Object.fromEntries(names.map(valueOf)), font: style.fontFamily };
}

/** Call `redraw` whenever these elements get another size, and whenever the page may have got another look: by a theme,
 * by its style sheet, which may load after the theme is named, or by the reader's system. Returns a function that ends
 * this. */
function watchLook(elements, redraw) {
  const [sizes, themes] = [new ResizeObserver(redraw), new MutationObserver(redraw)];
  for (const element of elements) sizes.observe(element);
  for (const element of [document.documentElement, document.body]) themes.observe(element, { attributes: true });
  const media = ["(prefers-color-scheme: dark)", "(prefers-contrast: more)", "(forced-colors: active)"].map(
    (query) => [matchMedia(query), "change"]);
  const sources = [...media, [window, "resize"], [document, "load"], [document.fonts, "loadingdone"]];
  const isCaptured = true; // since the load of a style sheet does not bubble
  for (const [source, event] of sources) source.addEventListener(event, redraw, isCaptured);
  return () => {
    for (const observer of [sizes, themes]) observer.disconnect();
    for (const [source, event] of sources) source.removeEventListener(event, redraw, isCaptured);
  };
}

/** Where a place lies on the arena's canvas, as a share of its side; and back. */
const shareOf = (place) => (place + BOARD_MARGIN) / (1 + 2 * BOARD_MARGIN);
const placeAt = (share) => share * (1 + 2 * BOARD_MARGIN) - BOARD_MARGIN;

const inSight = (place) => Math.max(-0.03, Math.min(1.03, place));
const clampedToBoard = (place) => Math.max(0, Math.min(1, place));

/** A context in units of CSS pixels, at the resolution of the screen. */
function fittedContext(canvas) {
  const { clientWidth, clientHeight } = canvas;
  const [width, height] = [clientWidth, clientHeight].map((side) => Math.round(side * devicePixelRatio));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  const context = canvas.getContext("2d");
  context.setTransform(width / (clientWidth || 1), 0, 0, height / (clientHeight || 1), 0, 0);
  context.clearRect(0, 0, clientWidth, clientHeight);
  return context;
}

/** Draw the arena. frame: from the engine, or null; cursor: a place, or none; trail: whether to draw it; elements: of
 * interest, where they are no buttons over the canvas. */
function drawArena(canvas, colours, frame, { cursor = null, trail = false, elements = [] } = {}) {
  const context = fittedContext(canvas);
  const unit = canvas.clientWidth / (1 + 2 * BOARD_MARGIN);
  context.translate(BOARD_MARGIN * unit, BOARD_MARGIN * unit);
  const board = { context, unit, colours };
  const walls = new Path2D();
  if (frame?.round) walls.arc(unit / 2, unit / 2, unit / 2, 0, FULL_TURN);
  else walls.rect(0, 0, unit, unit);
  context.save();
  context.clip(walls);
  if (frame?.heat) drawHeat(board, frame.heat);
  const cells = frame?.seen && cellsOf(frame.seen, frame.agent, frame.heading);
  if (cells) drawMap(board, cells, frame);
  drawObstacles(board, frame?.obstacles ?? []);
  context.restore();
  if (cells && frame.seen.goal !== null) drawWays(board, cells, frame);
  else if (frame?.field) drawField(board, frame);
  stroke(board, colours.ink, 1.4, 0.75, (path) => path.addPath(walls));
  if (frame?.current) drawCurrent(board, frame.current);
  if (trail && frame) drawTrail(board, frame.trail);
  if (frame) drawMovers(board, frame);
  drawElements(board, elements);
  if (cursor) drawCursor(board, cursor);
}

function drawMap(board, cells, { active, seen: { goal } }) {
  const { unit, colours } = board;
  for (const cell of new Set(active)) fillPath(board, colours.agent, 0.24, (path) => cells.addRegion(path, cell, unit));
  stroke(board, colours.ink, 0.8, cells.count > 16 ? 0.3 : 0.5, (path) => cells.addBorders(path, unit));
  if (goal === null) return;
  const addGoal = (path) => cells.addRegion(path, goal, unit);
  fillPath(board, colours.goal, 0.25, addGoal);
  stroke(board, colours.goal, 2.4, 1, addGoal);
}

/** Draw the way to the chosen cell from every other, with arrows as long as the cells allow. */
function drawWays(board, cells, { seen: { ways, goal, ofSelf }, round }) {
  const leading = ofSelf ? ways : ways.map((side, i) => (Math.floor(i / 2) === goal ? 0 : side)); // none out of the goal
  drawVectors(board, board.colours.goal, 2.2, 1, leading, (cell) => cells.middle(cell), round);
}

/** The receptive fields of a map in the world: their borders, the region of a cell, and its middle with its size. */
function cellsOf(map, agent, heading) {
  const origin = map.vector === "position" ? { x: 0, y: 0 } : agent;
  const scale = map.vector === "velocity" ? HALF_A_SECOND : 1; // where a velocity takes the agent in half a second
  const isRound = map.axes.some(({ feature }) => ["length", "direction", "bearing"].includes(feature));
  return isRound ? roundCells(map, origin, scale, heading) : squareCells(map, origin, scale);
}

/** The number of a cell's interval along an axis, the only one if there is no such axis. */
function intervalOf(cell, axis) {
  return axis ? Math.floor(cell / axis.stride) % (axis.borders.length - 1) : 0;
}

const intervalsOf = (axis) => (axis ? axis.borders.length - 1 : 1);

function squareCells({ axes, ends }, { x, y }, scale) {
  const [across, down] = [0, 1].map((along) => axes.find((each) => each.along === along));
  const placed = (axis, start) => (axis?.borders ?? [0, 1]).map((border) => {
    if (axis?.feature !== "margin") return start + scale * border;
    return border < 1e-9 ? border + axis.high : border + 1 - axis.high; // the middle of the board is the single value 0
  });
  const [xs, ys] = [placed(across, x), placed(down, y)];
  // Places beyond the range of a map belong to the cell at its end, unless the map ends there.
  const shown = (borders, index) => {
    const last = borders.length - 2;
    const isInner = [ends || index > 0, ends || index < last];
    return [0, 1].map((side) => (isInner[side] ? clampedToBoard(borders[index + side]) : side));
  };
  // On a closed axis, cells continue at the other side of the board.
  const shiftsOf = (axis) => (axis?.closed ? [-1, 0, 1] : [0]);
  const along = (borders, axis, cell) => {
    const index = intervalOf(cell, axis);
    return axis?.closed ? [borders[index], borders[index + 1]] : shown(borders, index);
  };
  const corners = (cell) => [...along(xs, across, cell), ...along(ys, down, cell)];
  const wrapped = (middle, axis) => (axis?.closed ? middle - Math.floor(middle) : middle);
  return {
    count: Math.max(intervalsOf(across), intervalsOf(down)),
    addBorders(path, unit) {
      const between = (borders, axis) => shiftsOf(axis).flatMap((shift) =>
        borders.slice(axis?.closed || ends ? 0 : 1, ends ? undefined : -1).map((border) => (border + shift) * unit));
      const [[left, right], [top, bottom]] = [xs, ys].map((each) =>
        (ends ? [each[0], each.at(-1)] : [0, 1]).map((border) => border * unit));
      for (const x of between(xs, across)) path.moveTo(x, top), path.lineTo(x, bottom);
      for (const y of between(ys, down)) path.moveTo(left, y), path.lineTo(right, y);
    },
    addRegion(path, cell, unit) {
      const [left, right, top, bottom] = corners(cell);
      for (const aside of shiftsOf(across)) {
        for (const below of shiftsOf(down)) {
          path.rect((left + aside) * unit, (top + below) * unit, (right - left) * unit, (bottom - top) * unit);
        }
      }
    },
    middle(cell) {
      const [left, right, top, bottom] = corners(cell);
      return { x: wrapped((left + right) / 2, across), y: wrapped((top + bottom) / 2, down),
        size: Math.min(right - left, bottom - top) };
    },
  };
}

/** heading: of the agent, from which bearings are measured, as directions are from the east. */
function roundCells({ axes, ends }, { x, y }, scale, heading) {
  const away = axes.find(({ feature }) => feature === "length");
  const around = axes.find(({ feature }) => ["direction", "bearing"].includes(feature));
  const ahead = around?.feature === "bearing" ? Math.atan2(heading[1], heading[0]) : 0;
  const [rings, sectors] = [intervalsOf(away), intervalsOf(around)];
  const radii = (away?.borders ?? [0, 1]).map((radius) => scale * radius);
  const angles = (around?.borders ?? [0, 1]).map((turns) => ahead + FULL_TURN * turns);
  const furthest = ends ? radii.at(-1) : BEYOND;
  const extent = (cell) => {
    const [ring, sector] = [intervalOf(cell, away), intervalOf(cell, around)];
    const [from, to] = sectors > 1 ? [angles[sector], angles[sector + 1]] : [0, FULL_TURN];
    return { inner: radii[ring], outer: ring < rings - 1 ? radii[ring + 1] : furthest, from, to, ring };
  };
  return {
    count: Math.max(rings, sectors),
    addBorders(path, unit) {
      for (const radius of radii.slice(1, ends ? undefined : -1)) {
        path.moveTo((x + radius) * unit, y * unit);
        path.arc(x * unit, y * unit, radius * unit, 0, FULL_TURN);
      }
      for (const angle of sectors > 1 ? angles.slice(1) : []) {
        path.moveTo(x * unit, y * unit);
        path.lineTo((x + furthest * Math.cos(angle)) * unit, (y + furthest * Math.sin(angle)) * unit);
      }
    },
    addRegion(path, cell, unit) {
      const { inner, outer, from, to } = extent(cell);
      const whole = to - from === FULL_TURN;
      path.arc(x * unit, y * unit, outer * unit, from, to);
      if (whole) path.moveTo((x + inner) * unit, y * unit);
      path.arc(x * unit, y * unit, inner * unit, to, from, true);
      if (!whole) path.closePath();
    },
    middle(cell) {
      const { inner, from, to, ring } = extent(cell);
      const width = rings > 1 ? radii[ring + 1] - inner : 0.36;
      const radius = inner + width / 2;
      const angle = sectors > 1 ? (from + to) / 2 : 0;
      const size = Math.min(width, sectors > 1 ? radius * (to - from) : width);
      return { x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle), size };
    },
  };
}

/** Draw the value at each tile as the depth of a colour, from the least to the greatest. */
function drawHeat({ context, unit, colours }, heat) {
  const tiles = Object.assign(document.createElement("canvas"), { width: FIELD_TILES, height: FIELD_TILES });
  const [paint, least, most] = [tiles.getContext("2d"), Math.min(...heat), Math.max(...heat)];
  if (least === most) return;
  heat.forEach((value, tile) => {
    Object.assign(paint, { fillStyle: colours.green, globalAlpha: 0.65 * (value - least) / (most - least) });
    paint.fillRect(tile % FIELD_TILES, Math.floor(tile / FIELD_TILES), 1, 1);
  });
  context.globalAlpha = 1;
  context.drawImage(tiles, 0, 0, unit, unit);
}

/** Draw where the agent has been, fading; it has jumped where the way between two places is long. */
function drawTrail(board, trail) {
  trail.slice(1).forEach((to, at) => {
    const from = trail[at];
    if (Math.hypot(to.x - from.x, to.y - from.y) > 0.4) return;
    stroke(board, board.colours.agent, 2.5, 0.6 * (at + 1) / trail.length, (path) =>
      addLine(path, [from, to].map(({ x, y }) => [x * board.unit, y * board.unit])));
  });
}

function drawField(board, { field, round }) {
  const [size, rowOf] = [1 / FIELD_TILES, (tile) => Math.floor(tile / FIELD_TILES)];
  drawVectors(board, board.colours.ink, 1.2, 0.5, field, (tile) =>
    ({ x: size * ((tile % FIELD_TILES) + 0.5), y: size * (rowOf(tile) + 0.5), size }), round);
}

/** Draw an arrow for each vector (x, y, x, y, …) around its middle, scaled by the fourth root, as in the book. */
function drawVectors(board, colour, width, alpha, vectors, middle, round) {
  let longest = 0;
  for (let i = 0; i < vectors.length; i += 2) longest = Math.max(longest, Math.hypot(vectors[i], vectors[i + 1]));
  if (!longest) return;
  stroke(board, colour, width, alpha, (path) => {
    for (let i = 0; i < vectors.length; i += 2) {
      const length = Math.hypot(vectors[i], vectors[i + 1]);
      const { x, y, size } = middle(i / 2);
      if (!length || !isDrawn({ x, y, size }, round)) continue;
      const drawn = 0.8 * Math.min(size, 0.2) * (length / longest) ** 0.25;
      const [dx, dy] = [(drawn * vectors[i]) / length, (drawn * vectors[i + 1]) / length];
      addArrow(path, board.unit, x - dx / 2, y - dy / 2, dx, dy, Math.min(9, 0.35 * drawn * board.unit));
    }
  });
}

const isDrawn = ({ x, y, size }, round) =>
  size > 0 && (round ? Math.hypot(x - 0.5, y - 0.5) < 0.5 : x >= 0 && x <= 1 && y >= 0 && y <= 1);

/** The share of a vector from a place that fits on the canvas. */
function roomFor(x, y, dx, dy) {
  const [least, most] = [-0.9 * BOARD_MARGIN, 1 + 0.9 * BOARD_MARGIN];
  const along = (place, change) => (change ? ((change > 0 ? most : least) - place) / change : 1);
  return Math.max(0, Math.min(1, along(x, dx), along(y, dy)));
}

function addArrow(path, unit, x, y, dx, dy, head) {
  path.moveTo(x * unit, y * unit);
  path.lineTo((x + dx) * unit, (y + dy) * unit);
  addHead(path, unit, x + dx, y + dy, dx, dy, head);
}

function addHead(path, unit, x, y, dx, dy, head) {
  for (const angle of [-0.5, 0.5].map((side) => Math.atan2(dy, dx) + side)) {
    path.moveTo(x * unit, y * unit);
    path.lineTo(x * unit - head * Math.cos(angle), y * unit - head * Math.sin(angle));
  }
}

function drawObstacles(board, obstacles) {
  const sides = Array.from(obstacles, (side) => side * board.unit);
  fillPath(board, board.colours.ink, 0.55, (path) => {
    for (let i = 0; i < sides.length; i += 4) {
      const [left, top, right, bottom] = sides.slice(i, i + 4);
      path.rect(left, top, right - left, bottom - top);
    }
  });
}

function drawCursor(board, { x, y }) {
  stroke(board, board.colours.goal, 2, 1, (path) => {
    for (const [dx, dy] of [[0.03, 0], [-0.03, 0], [0, 0.03], [0, -0.03]]) {
      addArrow(path, board.unit, x + dx / 4, y + dy / 4, dx, dy, 0);
    }
  });
}

function addLine(path, points) {
  for (const point of points) path.lineTo(...point);
}

function stroke({ context }, colour, width, alpha, add) {
  Object.assign(context, { strokeStyle: colour, lineWidth: width, globalAlpha: alpha, lineJoin: "round" });
  context.stroke(pathOf(add));
}

function fillPath({ context }, colour, alpha, add) {
  Object.assign(context, { fillStyle: colour, globalAlpha: alpha });
  context.fill(pathOf(add));
}

function pathOf(add) {
  const path = new Path2D();
  add(path);
  return path;
}

/** Write a text around a point, optionally with a halo that keeps it legible over anything. */
function write({ context, colours }, text, x, y, size, colour, halo = null, textAlign = "center") {
  Object.assign(context, { font: `${size} ${colours.font}`, textAlign, textBaseline: "middle", globalAlpha: 1,
    fillStyle: colour, strokeStyle: halo, lineWidth: 3 });
  if (halo) context.strokeText(text, x, y);
  context.fillText(text, x, y + 0.5);
}
