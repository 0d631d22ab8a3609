/* The Explorer's state in the address of its page, so that a link can identify a run, its settings and a moment of it.

The first Explorer of a page uses the fragment that begins with `#explorer`. In an application such as JupyterLab, whose
address is its own, the Explorer keeps nothing there, and links in a notebook lead to its first Explorer. The fragment
has the settings that differ from the preset, by their names in `SHORT`, also `run` and `seed`; the `minute` at which
the run pauses, and `second`; the `map` shown, with the `goal` chosen in it; the agent `beside` it, with the minutes for
which that one has `learned`; the `elements` dropped at that minute, each as x, y and valence; and `start`, one of the things to try. An
example is #explorer_agent-network-d_run-7_red-0p5. Without an agent, it means the one with which the page begins. Names
are in lower case, and p is the decimal point, because pages use a fragment as a selector, which allows few other
characters. */

const PREFIX = "#explorer";
const SHORT = { agent: "preset", run: "run", seed: "seed", resolutions: "resolutions", modality: "modality",
  recursion: "recursion", red: "valence_red", gains: "gains", exploration: "exploration", rate: "learning_rate",
  discount: "discount", memory: "memory", creeps: "n_creeps", state: "object_state" };
const LISTS = ["resolutions", "gains"];
const [MOST_LENGTHS, FAR] = [4, 1e6]; // of a preset's run, that a link leads through; minutes

const slug = (text) => text.toLowerCase().replaceAll(/[^a-z0-9]+/g, "-").replaceAll(/^-|-$/g, "");
const named = (names, text) => names.find((name) => slug(name) === text) ?? text;
const written = (number) => String(number).replace(".", "p");
const numberOf = (text) => (text.trim() === "" ? NaN : Number(text.replace("p", ".")));

const numbersOf = (text) => text.split(/(?<=\d)-/).map(numberOf); // another hyphen is a minus

/** Parse an address into {settings, minute, map, goal, beside, elements, start}, or null if it is not for an Explorer. */
function readAddress(hash, presets, modalities, first) {
  if (!hash.startsWith(PREFIX)) return null;
  const said = Object.fromEntries(hash.slice(PREFIX.length).split("_").filter(Boolean).map((part) => {
    const [, name, value] = part.match(/^([a-z]*)-?(.*)$/i);
    return [name, value];
  }));
  const valueOf = (name, text) => {
    if (name === "preset") return named(Object.keys(presets), text);
    if (name === "modality") return named(Object.keys(modalities), text);
    if (name === "object_state") return named(Object.keys(STATES), text);
    return LISTS.includes(name) ? numbersOf(text) : numberOf(text);
  };
  const given = Object.entries(SHORT).filter(([short]) => Object.hasOwn(said, short))
    .map(([short, name]) => [name, valueOf(name, said[short])]);
  const { preset: key = first } = Object.fromEntries(given);
  const defaults = Object.hasOwn(presets, key) ? { ...initialSettings(presets, key), seed: presets[key].seed } : {};
  const isSaid = (name) => Object.hasOwn(said, name);
  const other = isSaid("beside") ? valueOf("preset", said.beside) : null;
  const beside = other && { agent: other === key ? "" : other, learned: numberOf(said.learned ?? "0") };
  const [numbers, minute, second] = [isSaid("elements") ? numbersOf(said.elements) : [],
    ...["minute", "second"].map((name) => numberOf(said[name] ?? "0"))];
  const elements = Array.from({ length: Math.ceil(numbers.length / 3) }, (_, at) =>
    ({ x: numbers[3 * at], y: numbers[3 * at + 1], valence: numbers[3 * at + 2] }));
  return { beside, elements, settings: { ...defaults, preset: key, run: 0, ...Object.fromEntries(given) },
    minute: isSaid("minute") || isSaid("second") ? minute + second / 60 : null, start: said.start, map: said.map,
    goal: isSaid("goal") ? numberOf(said.goal) : null };
}

/** The address of the settings that differ from their preset's, and of the view. */
function addressOf(presets, settings, { seconds, map, goal, beside, elements }) {
  const { preset } = settings;
  const defaults = { ...initialSettings(presets, preset), preset: null, run: null, seed: presets[preset].seed };
  const parts = [PREFIX];
  for (const [short, name] of Object.entries(SHORT)) {
    const value = settings[name];
    if (JSON.stringify(value) === JSON.stringify(defaults[name])) continue;
    parts.push(`${short}-${Array.isArray(value) ? value.map(written).join("-")
      : typeof value === "string" ? slug(value) : written(value)}`);
  }
  const [minute, second] = [Math.floor(seconds / 60), Number((seconds % 60).toFixed(2))];
  if (seconds) parts.push(`minute-${minute}`, ...(second ? [`second-${written(second)}`] : []));
  if (goal !== null) parts.push(`map-${slug(map)}`, `goal-${goal}`);
  const numbers = elements.flatMap(({ x, y, valence }) => [x, y, valence].map((each) => Number(each.toFixed(3))));
  if (numbers.length) parts.push(`elements-${numbers.map(written).join("-")}`);
  if (beside) parts.push(`beside-${slug(beside.agent || preset)}`, `learned-${beside.learned}`);
  return parts.join("_");
}

/** Whether the page is JupyterLab, or another application of Jupyter's. */
const isInApplication = () => document.querySelector("#jupyter-config-data") !== null;

class Address {
  touched = false; // whether the reader has used a control
  visits = 0; // how many addresses were followed

  /** parts: {panel, traits, tank, hands, second, starters, places}, and functions {look, refresh, running} of the
   * Explorer. */
  constructor(parts) {
    Object.assign(this, parts);
  }

  /** Whether the page's address is this Explorer's. */
  isOwn() {
    return !isInApplication() && this.isFirstIn(document);
  }

  /** Whether this is the first Explorer of a page or a notebook, in whichever of its views it stands. */
  isFirstIn(part) {
    return this.places.includes(part.querySelector(".neorl-place"));
  }

  /** Open the run in the address, once the Explorer is part of the page. */
  arrive() {
    if (this.arrived || !this.panel.root.isConnected) return;
    this.arrived = true;
    if (this.isOwn()) this.visit(location.hash);
  }

  /** Follow a link that does not change the address: to the address that the page has already, or within a notebook. */
  followLink(event) {
    const link = event.target.closest("a");
    if (!link?.hash?.startsWith(PREFIX) || event.ctrlKey || event.metaKey || event.shiftKey) return; // or opens a tab
    const inApplication = isInApplication();
    const part = (inApplication && link.closest(".jp-Document")) || document;
    const isOfPart = inApplication ? link.getAttribute("href").startsWith("#") : link.href === location.href;
    if (!isOfPart || !this.isFirstIn(part)) return;
    if (inApplication) event.preventDefault();
    this.visit(link.hash);
  }

  /** Open the run that an address describes, if it is one of an Explorer; then set these traits, if any. */
  visit(hash, values = {}) {
    const { panel, traits, traits: { presets }, tank, hands, starters } = this;
    const said = readAddress(hash, presets, traits.modalities, traits.first);
    if (!said) return;
    const { settings, minute, map, goal, beside, elements, start } = said;
    const starts = { watch: () => starters.watch(), red: () => starters.revalueRed(),
      corner: () => starters.showCorner(), veteran: () => starters.meetVeteran(), game: () => starters.play() };
    const wish = (name) => (Object.hasOwn(settings, name) ? settings[name] : traits.get(name));
    const isMoment = minute === null || (minute >= 0 && minute < FAR);
    const areElements = elements.length <= MOST_ELEMENTS && elements.every(({ x, y, valence }) =>
      [x, y].every((place) => place >= 0 && place <= 1) && Math.abs(valence) <= 2);
    const problem = traits.problem(wish) || (isMoment ? "" : "Its minute must be a number ≥ 0.")
      || (areElements ? "" : `Its elements must be at most ${MOST_ELEMENTS}, each as x, y and a valence from −2 to 2.`)
      || this.second.problem(settings.preset, beside) || problemOfStart(presets[settings.preset], start);
    if (problem) {
      const message = panel.refusal(`The address does not describe a run of this Explorer. ${problem}`);
      panel.part(".tanks").before(message);
      panel.showTank();
      message.scrollIntoView({ block: "nearest" });
      return;
    }
    this.visits += 1;
    clearTimeout(this.writing); // the address of the run that is left
    panel.showTank();
    const { world, steps } = presets[settings.preset];
    const step = Math.min(MOST_LENGTHS * steps, Math.round((minute ?? 0) * 60 * world.fps));
    const act = async () => {
      if (minute !== null || isCalm()) traits.write({ playing: false });
      const cell = isWhole(0, MOST_SEED)(goal) ? goal : null;
      if (map) await this.look({ map: named(tank.run.frame.maps, map), goal: cell });
      if (Object.hasOwn(starts, start)) await starts[start]();
      traits.write(values);
      if (step) elements.forEach((each) => hands.addElement(each));
      this.refresh();
    };
    const due = { step, hurries: true, act, news: "Running up to that moment …" };
    starters.fresh({ ...settings, playing: true }, due, { beside, elements: step ? [] : elements });
  }

  /** The address of the settings and the view, and of the present moment, unless the run was changed on the way by more
   * than what is dropped there. A run in which red became desirable begins again. */
  now(isMoment) {
    const { traits, hands: { elements }, second: { beside }, tank: { run: { frame, changed, world, turn } } } = this;
    if (turn) return `${PREFIX}_agent-${slug(traits.get("preset"))}_start-red`;
    const settings = { ...traits.settings(), seed: traits.get("seed"), run: traits.get("run") };
    const seconds = isMoment && frame && (!changed || elements.length) ? frame.step / world.fps : 0;
    const { name: map = "", goal = null } = frame?.seen ?? {};
    return addressOf(traits.presets, settings, { seconds, map, goal, beside, elements });
  }

  /** Update the page's address, once the reader has used a control, without a new entry in the history. */
  write() {
    const { frame, due } = this.tank.run;
    if (!this.touched || this.panel.failed || !this.isOwn() || !frame || due) return;
    clearTimeout(this.writing);
    const write = () => history.replaceState(history.state, "", this.now(!this.running()));
    this.writing = setTimeout(write, 300);
  }
}
