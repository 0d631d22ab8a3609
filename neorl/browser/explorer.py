"""The Explorer: a widget that runs the book's own kernels in the reader's browser.

Everything it needs is in its state, so it works in a page without Python: the kernels in WebAssembly
(`neorl.browser.wasm`), its *presets* (agents as parameters, with the curves behind their runs, `neorl.browser.curves`),
and its traits, which are the controls.

- `settings.js` turns a preset and the traits into parameters, and `engine.js` runs them in a worker, which
  `simulator.js` starts, in the memory of `machine.js`; `changing.js` changes their agent. Nothing else affects a run:
  run k of a seed is the same as in `neorl.Run`. `views.js` defines what a frame shows of each world.
- `elements.js` makes elements of a page, `page.js` has the Explorer's, and `legend.js` its key; `drawing.js`,
  `movers.js` and `curve.js` draw.
- The Explorer is of parts: `panel.js` (its page), `traits.js`, `tank.js` (the run), `hands.js` (what the reader does in
  the tank), `beside.js` (the second tank), `controls.js`, `showing.js` (what is drawn and said), `starters.js` (things
  to try), `address.js` (its state in the page's address), `tour.js` and `saving.js`. `widget.js` gives them to each
  other, and `shared.js` has one Explorer for all views of a widget.
"""

import contextlib
from collections.abc import Mapping
from dataclasses import replace

import numpy as np

from neorl.agents import forager, papers, spaces
from neorl.agents.agent import LEARNED, STATES, Agent, Desire, Node
from neorl.agents.embodiment import choices_in, loop_of
from neorl.agents.rules import Learning, Policy
from neorl.browser import curves, wasm
from neorl.browser.figure import beginning, curve
from neorl.browser.living import Living, text_of
from neorl.browser.settings import (AVOIDED, SETTINGS, Checked, check, described, integers, reals, settings_of,
                                    stated_nodes)
from neorl.browser.worlds import IN_THE_PLANE, NAMES, rules_of, sizes_of
from neorl.common import checks
from neorl.common.extras import require
from neorl.core.building import choices_of
from neorl.core.modality import MODALITIES, PLACE_CELL
from neorl.experiments.condition import Condition
from neorl.experiments.result import Result
from neorl.experiments.simulation import label
from neorl.kernels.annotations import is_tuple
from neorl.worlds.arena import Arena
from neorl.worlds.arm import Arm
from neorl.worlds.vessel import Vessel
from neorl.worlds.water_maze import WaterMaze
from neorl.worlds.waterworld import WaterWorld

traitlets = require("traitlets", extra="wasm")

START_HERE = {"Foveated cells, contacts alone": forager.forager(valence_green=1.0, valence_red=-1.0),
              "Place and object-vector cells": papers.multimodal(),
              "Foveated cells, after-states": forager.forager(valence_green=1.0, valence_red=-1.0,
                                                              **forager.AFTER_STATES)}
OF_THE_PAPERS = {  # with the defaults of the package
    "Place cells": papers.place_cells(), "Object-vector cells": papers.object_vector_cells(),
    "Network A": papers.network_a(), "Network B": papers.network_b(), "Network C": papers.network_c(),
    "Network D": papers.network_d()}
TO_THE_LETTER = {
    "Place cells, to the letter": papers.place_cells(**papers.TO_THE_LETTER),
    "Object-vector cells, to the letter": papers.object_vector_cells(**papers.TO_THE_LETTER),
    "Place and object-vector cells, to the letter": papers.multimodal(place_gain=1.0, **papers.TO_THE_LETTER),
    "Network D, to the letter": papers.network_d(scale=papers.LITERAL_SCALE, **papers.TO_THE_LETTER)}
IN_THE_ARENA = {  # since the platform never moves, only exploration gets an agent out of a deadlock
    "Place cells in the water maze": Agent(
        [Node("PC", PLACE_CELL, [5, 9, 13])], [Desire("platform", "PC", 1.0)],
        Learning(learning_rate=0.05, discount=0.8, memory=2.0), Policy(exploration=0.5))}
OTHER_SPACES = {  # agents, and their worlds
    "Arm of two links": (spaces.reacher(2), Arm((0.5, 0.5), radius=0.15)),
    "Vessel with a radar": (spaces.pilot(), Vessel()),
    "Water maze, platform moved": (spaces.swimmer(), WaterMaze([(0.65, 0.35), (0.3, 0.3), (0.35, 0.7), (0.7, 0.6)]))}
GROUPS = {"Start here": START_HERE, "The papers, calibrated": OF_THE_PAPERS, "The papers, to the letter": TO_THE_LETTER,
          "Other worlds": IN_THE_ARENA | {name: agent for name, (agent, _) in OTHER_SPACES.items()}}
AGENTS = {name: agent for agents in GROUPS.values() for name, agent in agents.items()}
LABELS = {"Foveated cells, contacts alone": "Forager: foveated cells, contacts alone",
          "Foveated cells, after-states": "Forager that knows its own push: foveated cells, after-states"}
STEPS = 300_000  # of a run of an agent that is not a condition of the page
LITTLE_HAPPENS = 120_000  # first steps of networks of desires, which the page runs at full speed
SCRIPTS = ("elements.js", "settings.js", "simulator.js", "drawing.js", "movers.js", "curve.js", "page.js", "legend.js",
           "panel.js", "traits.js", "tank.js", "hands.js", "beside.js", "controls.js", "showing.js", "starters.js",
           "address.js", "tour.js", "saving.js", "widget.js", "waiting.js", "shared.js")
CONTROLS = ("preset", "resolutions", "modality", "object_state", "recursion", "valence_red")


class Explorer(Living):
    """A neoRL agent to watch, change and play against; in JupyterLab and, from its stored state, in a static page.

    conditions: {name: `Result`}, the conditions of the page, in worlds of the package; their bands and runs are shown.
        A `Condition` has no runs to show yet, and an `Agent` is put into WaterWorld with 3 creeps, or into the other
        space that it is a preset of. One of these can also be given without a name, and the name of a preset in their
        place. Each agent has a single valence for red (or for obstacles or vessels), a single one for recursion, a
        single state of object vectors, and no kernels of the user's own.
    preset: the name of a condition or of one of `neorl.browser.explorer.AGENTS`; by default the first condition or
        agent.
    behind: {name of a condition: (minutes, mean, low, high, what it is)}, curves of reward per second that are there at
        once, such as those of many runs made before, and over which the reader's own run is drawn; of a setting of a
        control, that of the condition that has it. minutes: of the run. mean, low, high: in as many equal parts of it,
        a mean and the ends of its interval. what it is: a text for the key, such as "1,000 runs".
    traits: initial values of any of the traits below.

    Traits: resolutions (1 … 90 each), modality (by name, with the preset's ranges if it is the preset's own; "" if the
    preset has more than one node or a modality of its own), object_state (of Cartesian object vectors with cells as
    goals: "object", with the preset's reach, "self" or "per object", as in `Node`; "" if the preset has none),
    recursion (None if there is none), valence_red (of obstacles or vessels in worlds where these are to be avoided),
    gains (one per node), exploration, learning_rate and discount (0 … 1), memory (≥ 0, in cells; 0 if it learns at
    every step), n_creeps (1 … 20; None outside WaterWorld), seed (below 2³²), run, speed (times real time, 0 for as
    fast as possible), playing; and, from the beginning only, control: one of `neorl.browser.explorer.CONTROLS`, which
    then stands beside the tank by itself, with the others folded, or by default "". A menu among them becomes buttons
    of what the conditions have, where that differs, and is folded itself. A run of each setting is drawn at full speed,
    beside the last run of another setting.
    Choosing a preset sets the traits that it determines. An agent that is not a condition is in the tank of the first
    condition in WaterWorld, or else in one with 3 creeps; an agent to the letter has the letter's steps per second and
    contacts; agents in the arena are in a `neorl.worlds.Arena`, and agents of other spaces in their own worlds.
    seconds and score follow the run, about once per second. All views of an Explorer share that run.

    Raises ValueError for a condition or a curve that cannot be shown, TraitError for a bad trait, and, but in
    JupyterLab, where the page says so, RuntimeError if a WebAssembly module cannot be built.
    """

    _esm = text_of(*SCRIPTS)
    _css = text_of("widget.css")
    _presets = traitlets.Dict().tag(sync=True)
    _modalities = traitlets.Dict().tag(sync=True)
    _agents = traitlets.Dict()  # of the presets, and their worlds
    _whole = False  # whether a preset is being set together with all of its settings
    _known = {}  # the last preset, and its settings

    preset = traitlets.Unicode().tag(sync=True)
    resolutions = Checked(integers, at_least=1, at_most=90).tag(sync=True)
    modality = traitlets.Unicode().tag(sync=True)
    object_state = traitlets.Unicode().tag(sync=True)
    recursion = Checked(checks.real, None, or_none=True).tag(sync=True)
    valence_red = Checked(checks.real, 0.0).tag(sync=True)
    gains = Checked(reals).tag(sync=True)
    exploration = Checked(checks.real, 0.0, at_least=0, at_most=1).tag(sync=True)
    learning_rate = Checked(checks.real, 0.0, at_least=0, at_most=1).tag(sync=True)
    discount = Checked(checks.real, 0.0, at_least=0, at_most=1).tag(sync=True)
    memory = Checked(checks.real, 0.0, at_least=0).tag(sync=True)
    n_creeps = Checked(checks.integer, None, or_none=True, at_least=1, at_most=20).tag(sync=True)
    seed = Checked(checks.integer, 0, at_least=0, at_most=2**32 - 1).tag(sync=True)
    run = Checked(checks.integer, 0, at_least=0, at_most=2**32 - 1).tag(sync=True)
    speed = Checked(checks.real, 20.0, at_least=0).tag(sync=True)
    playing = Checked(checks.flag, True).tag(sync=True)
    control = Checked(checks.one_of, "", options=("", *CONTROLS)).tag(sync=True)
    seconds = traitlets.Float().tag(sync=True)
    score = traitlets.Float().tag(sync=True)

    def __init__(self, conditions=None, preset=None, behind=None, **traits):
        with self._choosing(True):
            super().__init__(_modalities=_modalities(), **self._shown(conditions, preset, behind, traits))

    def show(self, conditions=None, preset=None, behind=None, **traits):
        """Show other conditions wherever this Explorer stands, such as results that have been computed since.

        Arguments are those of `Explorer`. All traits begin anew, but for control, which stays unless it is given.
        Raises what `Explorer` raises, and then goes on as before.
        """
        shown = self._shown(conditions, preset, behind, traits)
        with self._choosing(True), self.hold_sync(), self.hold_trait_notifications():
            for name, value in shown.items():
                setattr(self, name, value)
        self.send_state(shown.keys() & self.keys)  # also what was so here, since a page may have other values by now
        self._draw_again()

    def set_state(self, sync_data):
        """Set what a page has set, which chooses a preset together with its settings, and sends those that differ.

        Where other conditions have been shown meanwhile, what it has not sent may fit their preset alone.
        """
        try:
            with self._choosing(not set(SETTINGS).isdisjoint(sync_data)):
                super().set_state(sync_data)
        except traitlets.TraitError:
            if sync_data.get("preset") not in self._presets:
                raise
            with self._choosing(True):
                super().set_state(settings_of(self._presets[sync_data["preset"]]) | sync_data)

    @contextlib.contextmanager
    def _choosing(self, whole):
        self._whole = whole
        try:
            yield
        finally:
            self._whole = False

    def _shown(self, conditions, preset, behind, traits):
        """All traits that these arguments determine."""
        if isinstance(conditions, str) and preset is None:
            conditions, preset = None, conditions
        conditions = _by_name(conditions)
        for name, condition in conditions.items():
            _check_condition(name, condition)
        behind = curves.behind(behind, conditions)
        first = next(iter(conditions.values()), None)
        tanks = [each.world for each in conditions.values() if isinstance(each.world, WaterWorld)]
        tank = tanks[0] if tanks else WaterWorld()
        as_printed = replace(tank, fps=WaterWorld.fps, contact=WaterWorld.contact)
        agents = {name: (agent, as_printed if name in TO_THE_LETTER else Arena() if name in IN_THE_ARENA else tank)
                  for name, agent in AGENTS.items()} | OTHER_SPACES
        own = {name: (each.agent, each.world) for name, each in conditions.items()}
        start = {name: agents[name] for name in START_HERE}
        agents = start | own | agents | own  # in the menu's order; conditions replace agents of the same name
        presets = {name: _preset(name, agent, world, conditions.get(name))
                   | {"place": place, "behind": behind.get(name)}
                   for place, (name, (agent, world)) in enumerate(agents.items())}
        preset = next(iter(conditions or presets)) if preset is None else preset
        checks.one_of("preset", preset, tuple(presets))
        for name in traits:
            checks.one_of("trait", name, tuple(each for each in self.traits(sync=True) if not each.startswith("_")))
        defaults = {name: self.traits()[name].default_value for name in ("run", "speed", "playing")}
        return {"_agents": agents, "_presets": presets, **defaults, "preset": preset,
                "seed": first.seed if first else 0, **settings_of(presets[preset]), **traits}

    def _sentence(self):
        return f"An Explorer that runs {self._presets[self.preset]['label']}, in JupyterLab or a page with JavaScript."

    def _drawn(self):
        preset = self._presets[self.preset]
        drawn = preset["behind"] or preset["band"]
        return curve(drawn["edges"][1:], drawn["middle"]) if drawn else beginning(self.world, self.seed)

    @property
    def agent(self):
        """The `Agent` that the traits describe, without elements dropped in the page."""
        return described(*self._agents[self.preset], self._presets[self.preset], self._settings())[0]

    @property
    def world(self):
        """The agent's world."""
        return described(*self._agents[self.preset], self._presets[self.preset], self._settings())[1]

    def _settings(self):
        """The settings of the traits; of another preset its own, but for those that have been changed with it."""
        now = {name: getattr(self, name) for name in SETTINGS}
        if self._whole or self.preset == self._known["preset"]:
            return now
        own = settings_of(self._presets[self.preset])
        return {name: own[name] if value == self._known[name] else value for name, value in now.items()}

    @traitlets.validate("preset", *SETTINGS)
    def _check(self, proposal):
        name, value = proposal["trait"].name, proposal["value"]
        try:
            if name == "preset":
                return checks.one_of(name, value, tuple(self._presets))
            check(*self._agents[self.preset], self._presets[self.preset], self._settings() | {name: value})
            return value
        except ValueError as error:
            raise traitlets.TraitError(str(error)) from None

    @traitlets.observe("preset", *SETTINGS)
    def _take_settings(self, _):
        settings = self._settings()
        self._known = {"preset": self.preset, **settings}
        with self.hold_sync(), self.hold_trait_notifications():
            for name, value in settings.items():
                setattr(self, name, value)


def _by_name(conditions):
    """The conditions that an Explorer is to show, {name: `Result` or `Condition`}."""
    if isinstance(conditions, Result | Condition | Agent):
        conditions = {label(getattr(conditions, "agent", conditions)): conditions}
    kinds = "a Result, a Condition or an Agent"
    if not isinstance(conditions, Mapping | None):
        raise ValueError(f"conditions must be {kinds}, several by name, {{name: …}}, or the name of a preset, but is "
                         f"{checks.with_article(type(conditions).__name__)}")
    for name, condition in (conditions or {}).items():
        checks.instance("name of a condition", name, str)
        if not isinstance(condition, Result | Condition | Agent):
            raise checks.error(f"condition {name}", kinds, condition)
    return {name: Condition(each, _world_for(each), STEPS, runs=1) if isinstance(each, Agent) else each
            for name, each in (conditions or {}).items()}


def _world_for(agent):
    return next((world for each, world in OTHER_SPACES.values() if each == agent), WaterWorld())


def _check_condition(name, condition):
    agent = condition.agent
    for what, values in (("valences of red", {each.valence for each in agent.desires if each.source in AVOIDED}),
                         ("recursions", {each.valence for each in agent.desires if each.source == each.target}),
                         ("states of object vectors", {agent.nodes[n].state for n in stated_nodes(
                             agent.nodes, agent.learning, condition.world)})):
        if len(values) > 1:
            raise ValueError(f"{what} in condition {name} must be the same throughout, but are {values}")
    if any(each.valence == LEARNED for each in agent.desires):
        raise ValueError(f"valences in condition {name} must be numbers to be shown in the Explorer, but are learned")
    checks.integer(f"seed of condition {name}", condition.seed, at_least=0, at_most=2**32 - 1)
    if not isinstance(condition.world, (*IN_THE_PLANE, Vessel)):
        raise checks.error(f"world of condition {name}", "one of the package's, to be shown in the Explorer",
                           condition.world)
    for each in (agent, *(later for _, later in condition.changes)):
        if loop_of(each, whole=True) != wasm.MODULES[_module_of(condition.world)].loop:
            raise ValueError(f"condition {name} must have the kernels that are compiled for the page, with the greedy "
                             "choice, but has its own, for an axis, the credit or the choice of an action")


def _preset(name, agent, world, condition):
    """A preset in the page's format: its settings, the chosen parameters, and the results of its runs, if any."""
    result = condition if isinstance(condition, Result) else None
    red = [e for e, desire in enumerate(agent.desires) if desire.source in AVOIDED]
    recurring = [e for e, desire in enumerate(agent.desires) if desire.source == desire.target]
    names = [node.name for node in agent.nodes]
    modality = agent.nodes[0].modality
    learning = agent.learning
    stated = stated_nodes(agent.nodes, learning, world)
    in_menu = _named(modality) if len(names) == 1 else ""
    could_be = in_menu and agent.nodes[0].goals == "cells" and learning.update_on == "cell"
    return {
        "label": LABELS.get(name, name), "nodes": names,
        "is_condition": condition is not None,
        "group": "On this page" if condition else next(group for group, agents in GROUPS.items() if name in agents),
        "resolutions": list(agent.nodes[0].resolutions),
        "modality": in_menu,
        "object_state": agent.nodes[stated[0]].state if stated else "", "stated": stated,
        "states": list(STATES) if stated else ["", *STATES] if could_be else [""],  # with another modality it could be
        "gains": [node.gain for node in agent.nodes], "exploration": agent.policy.exploration,
        "learning_rate": learning.learning_rate, "discount": learning.discount, "memory": learning.memory,
        "can_remember": learning.update_on == "cell",
        "valence_red": agent.desires[red[0]].valence if red else 0.0,
        "recursion": agent.desires[recurring[0]].valence if recurring else None,
        "n_creeps": world.n_creeps if isinstance(world, WaterWorld) else None, "world": world_in_page(world),
        "steps": condition.steps if condition else STEPS, "begins": _begins(agent, condition),
        "red": red, "avoided": agent.desires[red[0]].source if red else "", "recurring": recurring,
        "seed": condition.seed if condition else 0, "runs": result.runs if result else 0,
        "band": curves.band(result) if result else None, "totals": result.totals.tolist() if result else [],
        "changes": [{"step": step, "parameters": parameters_in_page(later, world)}
                    for step, later in (condition.changes if condition else ())],
        "parameters": parameters_in_page(agent, world)}


def _begins(agent, condition):
    """The step with which the page begins a run that is watched."""
    is_network = any(agent.comes_from_node(each) for each in agent.desires)
    return LITTLE_HAPPENS if is_network and (condition.steps if condition else STEPS) > LITTLE_HAPPENS else 0


def world_in_page(world):
    """A world in the page's format; of the rules of other worlds, only the scalars."""
    rules, module = _as_json(rules_of(world)), _module_of(world)
    name = NAMES[rules["world"]] if module == "plane" else "vessel"
    for other in NAMES if module == "plane" else ():
        if other != name:
            rules[other] = {key: value for key, value in rules[other].items() if not isinstance(value, list)}
    return {"name": name, "module": module, "fps": world.fps, "kinds": list(world.kinds), "things": world.things,
            "sizes": {key: sizes_of(world)[key] for key in ("obstacles", "places", "trials")}, "rules": rules}


def _module_of(world):
    return "plane" if isinstance(world, IN_THE_PLANE) else "helm"


def _named(modality):
    """The name of a modality if it is one of `MODALITIES`, apart from its ranges, else ""."""
    return modality.name if _without_ranges(modality) in map(_without_ranges, MODALITIES) else ""


def _without_ranges(modality):
    return modality.name, modality.landmarks, [(each.of, each.feature, each.along, each.closed, each.intervals,
                                                each.boundaries) for each in modality.axes]


def parameters_in_page(agent, world):
    """The chosen parameters, ready for JSON, and the names that the page shows."""
    edges = [{"source": each.source if agent.comes_from_node(each) else None, "target": each.target,
              "of": list(each.of)} for each in agent.desires]
    return _as_json(choices_in(agent, world)) | {"names": [node.name for node in agent.nodes], "edges": edges}


def _as_json(values):
    values = values._asdict() if is_tuple(values) else values
    if isinstance(values, dict):
        return {name: _as_json(value) for name, value in values.items()}
    if isinstance(values, list | tuple):
        return [_as_json(value) for value in values]
    return values.tolist() if isinstance(values, np.ndarray | np.generic) else values


def _modalities():
    """The parameters of a node of each modality, by name, and whether its state can be chosen."""
    return {each.name: {"node": _as_json(choices_of([each])[0]),
                "stated": stated_nodes([Node(each.name, each, [1])], Learning(), WaterWorld()) == [0]}
            for each in MODALITIES if each.takes_places}
