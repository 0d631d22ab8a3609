/* What the tank shows, in words: the key beside it, and a description for screen readers. */

const SPELLED_OUT = new Map(Object.entries({ PC: "place cells", OVC: "object-vector cells",
  "OVC × V": "object vector and velocity", joints: "postures of the arm", far: "radar, whole area",
  near: "radar, near range", place: "place cells" })); // nodes, whose names may be any text
const [LINE, HEAD] = ["M2 8H21", "M16 4L21 8L16 12"];
const picture = (content) => `<svg viewBox="0 0 24 16" aria-hidden="true">${content}</svg>`;
const [MINUS, PLUS] = ["M8 8h8", "M8 8h8M12 4v8"];
const disc = (kind, sign) => picture(`<circle class="${kind} full" cx="12" cy="8" r="7.5"/>
  <path class="sign" d="${sign}"/>`);
const discs = (kind) => ({ [`${kind}+`]: disc(kind, PLUS), [`${kind}−`]: disc(kind, MINUS), [kind]: disc(kind, "") });
const arrow = (kind) => picture(`<path class="${kind}" d="${LINE}"/><path class="${kind} solid" d="${HEAD}"/>`);
const PICTURES = {
  agent: picture(`<path class="motion" d="M12 8H23"/><circle class="agent full" cx="9" cy="8" r="7.5"/>`),
  ...discs("green"), ...discs("red"), player: picture(`<circle class="player" cx="12" cy="8" r="6.5"/>
    <text x="12" y="12">Y</text>`),
  place: picture(`<circle class="place" cx="12" cy="8" r="6.5"/>`),
  heat: picture(`<rect class="heat" x="4" y="0.5" width="16" height="15"/>`),
  active: picture(`<rect class="active" x="4" y="0.5" width="16" height="15"/>`),
  hidden: picture(`<circle class="hidden" cx="12" cy="8" r="6.5"/>`),
  hull: picture(`<path class="agent full" d="M22 8L12 13H3V3H12Z"/>`),
  vessel: picture(`<path class="red full" d="M22 8L12 13H3V3H12Z"/>`), current: arrow("current"),
  field: arrow("field"), desire: arrow("desire"), way: arrow("way"),
  landing: picture(`<path class="green full" d="M12 0L20 8L12 16L4 8Z"/><path class="sign" d="M9 8h6M12 5v6"/>`),
};

/** The name of a node, in words if it is blank. */
const titleOf = (name) => (name.trim() ? name : "unnamed");

/** The entries of the key for a frame: [picture, text], or with a list of texts and of nodes, {name}. */
function keyOf(frame) {
  const { things, nodes, landings, player, active, field, heat, seen, arm, heading, hidden, current, wants } = frame;
  const kinds = new Set(things.map(({ kind }) => kind));
  const creep = (kind, pays) => {
    const sign = signOf(kind, wants);
    return [`${kind}${sign}`, `${kind === "green" ? "Green" : "Red"} creep: pays ${pays}${
      pays.startsWith(sign) ? "" : `, but is ${sign === "+" ? "wanted" : "avoided"}`}`];
  };
  const wishing = nodes.filter(({ valence }) => valence).flatMap(({ name }, at) => {
    const long = SPELLED_OUT.get(name);
    return [at ? "; " : "", { name }, long ? `, ${long}` : ""];
  });
  const entries = [
    ["agent", arm ? "In joint space: the posture of the arm"
      : "The agent; the line ends where its velocity would take it in half a second", !heading],
    ["hull", "The vessel; the line ends where its velocity would take it in half a second", heading],
    [`green${signOf("target", wants)}`, "Target: pays +1 (one of its postures)", kinds.has("target")],
    [`red${signOf("obstacle", wants)}`, "Obstacle: pays −1 (one of its postures)", kinds.has("obstacle")],
    ["place", "Waypoint: pays +1", kinds.has("waypoint")], ["vessel", "Another vessel: a collision pays −1",
      kinds.has("vessel")],
    ["current", "The current, which the agent does not perceive", current?.some(Boolean)],
    ["hidden", "The hidden platform: pays +1 and ends the trial", hidden],
    ["player", "You", player],
    [...creep("green", "+1"), kinds.has("green")], [...creep("red", "−1"), kinds.has("red")],
    ["place", hidden ? "Where the animal remembers the platform" : "Platform", kinds.has("platform")],
    ["active", "Shaded: the active cell of the map shown", active.length],
    ["heat", "Green ground: the value of the best action, deeper where it is greater", heat],
    ["field", `Grey: what the agent would do at each place${heading ? ", on this heading" : ""}, by all maps together`,
      field && seen.goal === null],
    ["desire", ["Dashed: the desire vectors of nodes: ", ...wishing], wishing.length],
    ["landing", "Where the desire of one node places an element for another", landings.length],
    ["way", seen.ofSelf ? "The chosen cell; in each cell, the way there" : "The chosen cell, and the learned way to "
      + "it from others", seen.goal !== null],
  ];
  return entries.filter((entry) => entry.length < 3 || entry[2]).map((entry) => entry.slice(0, 2));
}

function entryOf([kind, ...texts]) {
  const parts = texts.flat().map((each) => (typeof each === "string" ? each : element("b", {}, titleOf(each.name))));
  return element("li", {}, elementOf(PICTURES[kind]), element("span", {}, ...parts));
}

/** The name of a map, such as "PC N5", with its numbers of intervals along the axes. */
function inWords(map, shape) {
  const node = map.slice(0, map.lastIndexOf(" N"));
  return `${SPELLED_OUT.get(node) ?? titleOf(node)}, ${shape}`;
}

/** What an agent is called by the setting that a control is for. */
function settingInWords(control, settings, presets) {
  const labelOf = (key) => presets[key].label.split(": ").at(-1); // without its figure
  const value = settings[control] ?? "";
  if (value === "") return labelOf(settings.preset); // an agent without such a setting
  const { modality, nodes: [node] } = presets[settings.preset];
  const texts = { resolutions: () => inOrder(value).map((n) => `N${n}`).join(", "), object_state: () => STATES[value],
    modality: () => (value === modality ? SPELLED_OUT.get(node) ?? titleOf(node) : value), preset: () => labelOf(value) };
  return texts[control]?.() ?? `${NAMES[control]} ${shown(value)}`;
}

/** What is drawn of the way to the chosen cell. */
function describeWay({ seen, agent, heading, round }) {
  const { axes, goal, ofSelf, vector, ways } = seen;
  const { middle } = cellsOf(seen, agent, heading);
  const hasArrow = (cell) => ways[2 * cell] !== 0 || ways[2 * cell + 1] !== 0;
  if (ofSelf) {
    return hasArrow(goal) ? "The arrow in the chosen cell is the way there, learned without being asked."
      : "The chosen cell has no arrow: the way there has not been learned.";
  }
  const others = [...Array(ways.length / 2).keys()].filter((cell) => cell !== goal && isDrawn(middle(cell), round));
  const learned = others.filter(hasArrow);
  if (!learned.length) return "No cell has an arrow: the way to the chosen one has not been learned.";
  const said = `Arrows in ${learned.length} of the ${others.length} other cells, learned without being asked`;
  if (vector !== "position") return `${said}.`;
  const shortest = (way, along) => (axes.find((each) => each.along === along)?.closed ? way - Math.round(way) : way);
  const towards = learned.filter((cell) => {
    const [from, to] = [middle(cell), middle(goal)];
    return shortest(to.x - from.x, 0) * ways[2 * cell] + shortest(to.y - from.y, 1) * ways[2 * cell + 1] > 0;
  });
  return `${said}; ${towards.length} point towards the chosen one.`;
}

/** A description of a frame, in a few sentences. */
function describe({ agent, things, player, ended }) {
  const moving = Math.hypot(agent.vx, agent.vy) > 0.02;
  const said = [`The agent is ${whereabouts(agent)}, ${moving ? `moving ${heading(agent.vx, agent.vy)}` : "at rest"}.`];
  const counts = Object.entries(Object.groupBy(things, ({ kind }) => kind ?? "hidden place"))
    .map(([kind, { length }]) => `${length} ${kind}`);
  if (counts.length) said.push(`Around it: ${counts.join(", ")}.`);
  const away = ({ x, y }) => Math.hypot(x - agent.x, y - agent.y);
  const nearest = things.filter(({ kind }) => kind).sort((one, other) => away(one) - away(other))[0];
  if (nearest) {
    const side = heading(nearest.x - agent.x, nearest.y - agent.y);
    said.push(`The nearest is ${nearest.kind}, ${shown(away(nearest).toFixed(2))} board widths away, ${side}.`);
  }
  if (player) said.push(`You are ${whereabouts(player)}.`);
  if (ended) said.push("The run is over.");
  return said.join(" ");
}

function whereabouts({ x, y }) {
  const [across, down] = [x, y].map((each) => Math.max(0, Math.min(2, Math.floor(3 * each))));
  if (across === 1 && down === 1) return "in the middle";
  return `at the ${[["top", "", "bottom"][down], ["left", "", "right"][across]].filter(Boolean).join(" ")}`;
}

const HEADINGS = ["right", "down right", "down", "down left", "left", "up left", "up", "up right"];

function heading(dx, dy) {
  return HEADINGS[(Math.round((8 * Math.atan2(dy, dx)) / FULL_TURN) + 8) % 8];
}
