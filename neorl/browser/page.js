/* The Explorer's markup and constants, and small helpers of its parts. */

const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 0]; // times real time; 0: as fast as possible
const [TIMED_BUDGET, FREE_BUDGET, WHOLE_BUDGET] = [12, 32, 100]; // milliseconds
const STEPS_WITHOUT_END = 1e9;
const [MOST_ELEMENTS, MOST_SEED, NO_ACTION] = [5, 2 ** 32 - 1, 4];
const [DOUBLE_TAP, NEARBY] = [350, 0.06]; // milliseconds and board widths between the two taps
const NO_MEMORY = -1; // its position on the slider, which has logarithms to base ten
const THRUST_EVERY = 90; // milliseconds; a held key pushes for single steps, since the player could not steer otherwise
const [REACH, SLOW, REACHING] = [0.05, 0.2, 1500]; // near a creep: board widths, times real time, milliseconds
const TO_WATCH = ["red", "watch", "corner", "compare", "game"]; // things to try, for which the tank comes into sight
const KEYS = { ArrowUp: [0, 0, -1], ArrowDown: [1, 0, 1], ArrowRight: [2, 1, 0], ArrowLeft: [3, -1, 0] };
const NEW_RUN = ["preset", "memory", "resolutions", "modality", "object_state", "n_creeps", "seed", "run"];
const ALLOWED = "Resolutions are whole numbers from 1 to 90, such as 3, 5, 7.";
const STATES = { self: "the self (goal: the object's cell)", "per object": "the self, per object",
  object: "the object's cell (goal: contact)" };
const AVOIDED = { red: "red", obstacle: "obstacles", vessel: "vessels" };
const WHOLE = ({ min, max }) => `Whole numbers from ${min} to ${max} are allowed here.`;
const STOPPED = "The simulation has stopped. Reset restarts it.";
const [CLICK, STEER] = matchMedia("(pointer: coarse)").matches
  ? ["Tap", "Steer with the four buttons."] : ["Click", "Steer with the arrow keys; Escape leaves the game."];
const HINTS = [`${CLICK} a cell to see the way to it.`, `Double-${CLICK.toLowerCase()} to drop an element of interest.`,
  "Drag the creeps."];
const WHERE = `${CLICK} where to drop the element of interest.`;
const HELP = { // for a control that stands beside the tank by itself
  resolutions: "Cells along each side of a map. An agent has one map per number; other numbers begin a new run.",
  modality: "What the cells are tuned to. Another modality begins a new run.",
  object_state: "What an object-vector map learns. Another state begins a new run.",
  recursion: "The weight with which a desire is passed back to its own node. Another weight begins a new run.",
  valence_red: "What the agent wants. Another valence begins a new run.",
  preset: "Another agent begins a new run, with nothing learned." };
const NAMES = { recursion: "r =", valence_red: "red" }; // of settings that are numbers
const CHIPS = [2, 3, 5, 7, 11, 13]; // resolutions to press, besides those of the agent's maps
const LABELS = { red: "Make red good", corner: "Show the way to a corner" }; // of what takes a while, and can be stopped
const OF_PAGE = "On this page"; // the group of a page's own agents

const slide = (name, label, least, most, step) => `<label class="slide"><span>${label}</span><input type="range"
  name="${name}" min="${least}" max="${most}" step="${step}"><output></output></label>`;
const choice = (name, label) => `<label class="labelled"><span>${label}</span><select name="${name}"></select></label>`;
const number = (name, label) => `<label class="labelled"><span>${label}</span><input type="number" name="${name}"
  min="0" max="${MOST_SEED}" value="0" required></label>`;
const tick = (name, label, state) => `<label class="tick"><input type="checkbox" name="${name}" ${state}>${label}
  </label>`;
const toggle = (name, label) => `<label class="tick"><input type="checkbox" role="switch" name="${name}">${label}
  </label>`;
const press = (action, label) => `<button type="button" data-action="${action}">${label}</button>`;
const chip = (n) => element("button", { type: "button", dataset: { chip: n }, ariaLabel: `Resolution ${n}` }, n);
const pick = (preset, text) => element("button", { type: "button", dataset: { pick: preset } }, text);
const pad = (key) => `<button type="button" data-key="Arrow${key.slice(0, -2)}" aria-label="${key.slice(0, -2)}">
  ${key.at(-1)}</button>`;
const graph = (kind, title, label) => `<p class="title of-${kind}">${title}</p><canvas class="${kind}" role="img"
  aria-label="${label}"></canvas>`;
// The tank comes first, also for the keyboard.
const pageOf = (id) => `<div class="neorl-explorer"><p role="alert" hidden></p>
  <div class="columns"><div class="board"><p class="minutes"></p>
    <progress class="idle" value="0" aria-label="How far the run has come"></progress>
    <div class="aims"><p class="wants"></p><p class="counts"></p></div>
    <div class="tanks"><div class="first"><p class="named" hidden></p>
      <div class="space"><p class="title" hidden>Joint space: first joint across, second down</p>
      <div class="arena"><canvas tabindex="0" role="application" aria-describedby="${id}" aria-label="The world. Space
      plays and pauses; arrow keys move a cursor, Enter chooses the cell under it, Escape deselects it."></canvas>
      <div class="grips"></div><div class="marks"></div></div></div></div>
      <div class="second" hidden><p class="named"></p><canvas role="img" aria-label="The second tank"></canvas></div></div>
    <div class="pad" hidden>${["Left ←", "Up ↑", "Down ↓", "Right →"].map(pad).join("")}</div>
    <div class="buttons">${press("play", "Play")}${press("go-on", "Go on")}${press("red", LABELS.red)}
      ${press("reset", "Reset")}${press("tour", "Take the tour")}</div>
    <div class="versus" hidden>${choice("beside", "Second tank")}${choice("learned", "has learned for")}</div>
    <div class="shown">${toggle("learns", "Learning")}<div class="shown" role="group" aria-label="Show in the tank">
      <span>Show</span>${tick("field", "Arrows", "checked")}${tick("heat", "Value", "")}
      ${tick("trail", "Trail", "checked")}</div></div>
    <p class="unseen" id="${id}"></p><p class="said"></p>
    <div class="starters buttons" role="group" aria-label="Things to try">${press("compare", "Newborn beside veteran")}
      ${press("game", "Play against it")}${press("drop", "Drop an element")}</div>
    <div class="element" hidden>${slide("element-valence", "Its valence", -2, 2, 0.1)}
      ${press("delete", "Delete")}${press("clear", "Delete all")}</div>
    <div class="shown">${choice("map", "Map shown")}</div></div>
  <div class="side"><div class="limb" hidden><p class="title">Workspace: the plane in which the arm moves</p>
    <canvas role="img" aria-label="The arm in the plane, with the points that it seeks and avoids"></canvas></div>
    <div class="bar">${choice("preset", "Agent")}${slide("speed", "Speed", 0, SPEEDS.length - 1, 1)}</div>
    ${graph("curve", "Reward per second", "Reward per simulated second over the run, in minutes")}
    ${graph("catches", "Met a minute", "What the agent meets in a simulated minute, by kind, over the run")}
    <p class="legend"></p><p class="pace"></p>
    <div class="settings">${choice("modality", "Modality")}${choice("object_state", "State of object vectors")}
    <div class="setting"><label class="labelled"><span>Resolutions</span><input type="text" name="resolutions"
      autocomplete="off"></label>
    <div class="chips" role="group" aria-label="Resolutions"></div></div>
    ${slide("recursion", "Weight of recursion", -3, 1, 0.1)}${slide("valence_red", "Valence of red", -2, 2, 0.1)}
    <div class="open">${number("open-run", "Open run")}<span class="of"></span>${press("open", "Open")}</div></div></div>
  <ul class="key" aria-label="What the tank shows"></ul></div>
  <p class="refused" role="status"></p>
  <details><summary>More</summary><div class="more"><div class="tools buttons">${press("step", "Step")}
    ${press("new-run", "New run")}${press("watch", "Watch it learn")}${press("corner", LABELS.corner)}
    ${press("link", "Copy link")}${press("picture", "Save picture")}${press("csv", "Save as CSV")}
    ${press("alone", "Tank only")}</div>${slide("exploration", "Exploration ε", 0, 1, 0.01)}
    ${slide("learning_rate", "Learning rate α", -3, 0, 0.01)}
    ${slide("horizon", "Horizon, cells", 0, 3, 0.01)}${slide("memory", "Memory, cells", NO_MEMORY, 3, 0.01)}
    ${slide("n_creeps", "Creeps", 1, 12, 1)}<div class="gains"></div>
    ${number("seed", "Seed")}${number("run", "Run")}</div></details><p class="unseen told" aria-live="polite"></p>
  <section class="tour" aria-label="Guided tour" hidden><p id="${id}-tour" role="status"></p><div class="buttons">
    <button type="button" data-action="next" aria-describedby="${id}-tour">Next</button>${press("end", "Stop")}</div>
    </section></div>`;

const power = (exponent) => Number((10 ** exponent).toPrecision(2)); // as on the logarithmic sliders
const shown = (value) => String(Number(Number(value).toPrecision(value >= 1000 ? 9 : 3))).replace("-", "−");
const signed = (value) => (value > 0 ? "+" : "") + shown(value);
const grouped = (value) => Math.round(value).toLocaleString("en-GB");
const isWhole = (low, high) => (value) => Number.isInteger(value) && value >= low && value <= high;
const isList = (value, test) => Array.isArray(value) && value.length > 0 && value.every(test);
const isSame = (one, other) => JSON.stringify(one) === JSON.stringify(other);
const inOrder = (numbers) => [...new Set(numbers)].sort((a, b) => a - b);
const shifted = ({ x, y }, dx, dy, by) => ({ x: clampedToBoard(x + by * dx), y: clampedToBoard(y + by * dy) });
const isCalm = () => matchMedia("(prefers-reduced-motion: reduce)").matches;
const indexOf = (element) => [...element.parentElement.children].indexOf(element);

/** Fill a menu with agents, in groups, after an option of its own, if any. */
function fillMenu(menu, presets, keys, first = null) {
  const groups = Object.groupBy(keys, (key) => presets[key].group);
  menu.replaceChildren(...(first ? [first] : []), ...Object.entries(groups).map(([label, members]) =>
    element("optgroup", { label }, ...members.map((key) => new Option(presets[key].label, key)))));
}

/** Add or remove children until there are `count`. */
function grow(parent, count, make) {
  while (parent.children.length > count) parent.lastChild.remove();
  while (parent.children.length < count) parent.append(make(parent.children.length));
}
