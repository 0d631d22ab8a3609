"""The settings of an Explorer: what each may be for a preset, and the agent and the world that they describe."""

from dataclasses import replace

from neorl.agents.embodiment import choices_in
from neorl.common import checks
from neorl.common.extras import require
from neorl.core.modality import MODALITIES
from neorl.worlds.waterworld import WaterWorld

traitlets = require("traitlets", extra="wasm")

SETTINGS = ("resolutions", "modality", "object_state", "recursion", "valence_red", "gains", "exploration",
            "learning_rate", "discount", "memory", "n_creeps")  # the traits that a preset determines
AVOIDED = ("red", "obstacle", "vessel")  # the kinds whose valence has a control


class Checked(traitlets.TraitType):
    """A trait whose value is what a function of `neorl.common.checks` returns, ``check(name, value, **allowed)``.

    or_none: whether it may be None, which is then checked against the preset, as any other value is.
    """

    def __init__(self, check, default_value=traitlets.Undefined, or_none=False, **allowed):
        super().__init__(default_value)
        self._check, self._or_none, self._allowed = check, or_none, allowed

    def validate(self, obj, value):
        try:
            return None if value is None and self._or_none else self._check(self.name, value, **self._allowed)
        except ValueError as error:
            raise traitlets.TraitError(str(error)) from None


def integers(name, values, **allowed):
    """`values` as a list of one or more integers."""
    return [checks.integer(name, each, **allowed) for each in _several(name, values)]


def reals(name, values):
    """`values` as a list of one or more numbers."""
    return [checks.real(name, each) for each in _several(name, values)]


def _several(name, values):
    if not (values := checks.several(name, values)):
        raise checks.error(name, "a list of one number or more", [])
    return values


def settings_of(preset):
    """The values that a preset, in the page's format, has for the traits that it determines."""
    return {name: preset[name] for name in SETTINGS}


def stated_nodes(nodes, learning, world):
    """The numbers of the nodes of Cartesian object vectors with cells as goals, whose state can be chosen."""
    return [n for n, node in enumerate(nodes) if learning.update_on == "cell" and node.goals == "cells"
            and node.modality.follows == "objects" and node.modality.is_cartesian
            and len(node.modality.axes) == world.actions.axes]


def described(agent, world, preset, settings):
    """The agent and the world that the settings make of those of a preset. Raises ValueError if there are none."""
    own = settings["resolutions"] == preset["resolutions"]
    nodes = [replace(node, resolutions=node.resolutions if own else settings["resolutions"], gain=gain)
             for node, gain in zip(agent.nodes, settings["gains"])]
    if settings["modality"] not in ("", preset["modality"]):
        named = {each.name: each for each in MODALITIES}
        nodes = [replace(nodes[0], modality=named[settings["modality"]], state="object", reach=0.0,
                         beyond="outermost")]
    for n in stated_nodes(nodes, agent.learning, world):
        state = settings["object_state"] or "object"
        nodes[n] = replace(nodes[n], state=state, reach=nodes[n].reach if state == "object" else 0.0)
    desires = [replace(each, valence=settings["valence_red"]) if each.source in AVOIDED else
               replace(each, valence=settings["recursion"]) if each.source == each.target else each
               for each in agent.desires]
    learning = replace(agent.learning, **{name: settings[name] for name in ("learning_rate", "discount", "memory")})
    return (replace(agent, nodes=nodes, desires=desires, learning=learning,
                    policy=replace(agent.policy, exploration=settings["exploration"])),
            replace(world, n_creeps=settings["n_creeps"]) if isinstance(world, WaterWorld) else world)


def check(agent, world, preset, settings):
    """Raise ValueError if a setting is none that a preset can have, or if they describe no agent in its world."""
    label, modality, red = preset["label"], settings["modality"], settings["valence_red"]
    if modality and not (preset["modality"] and agent.nodes[0].goals == "cells"):
        raise checks.error("modality", f"'' for {label}, whose nodes keep their own", modality)
    checks.one_of("modality", modality, ["", *(each.name for each in MODALITIES if each.takes_places)])
    checks.one_of("object_state", settings["object_state"], preset["states"])
    if isinstance(world, WaterWorld):
        checks.integer("n_creeps", settings["n_creeps"], at_least=1, at_most=20)
    elif settings["n_creeps"] is not None:
        raise checks.error("n_creeps", "None outside WaterWorld", settings["n_creeps"])
    if preset["recursion"] is not None:
        checks.real("recursion", settings["recursion"])
    elif settings["recursion"] is not None:
        raise checks.error("recursion", f"None for {label}, which passes no desire to its own node",
                           settings["recursion"], "choose an agent that does, such as 'Network D'")
    if not preset["red"] and red != preset["valence_red"]:
        raise checks.error("valence_red", f"{preset['valence_red']:g} for {label}, for which nothing is to be avoided",
                           red)
    if settings["memory"] and not preset["can_remember"]:
        raise checks.error("memory", "0 for an agent that learns at every step", settings["memory"])
    if len(settings["gains"]) != len(agent.nodes):
        raise checks.error("gains", f"a number for each of the {len(agent.nodes)} nodes", settings["gains"])
    choices_in(*described(agent, world, preset, settings))
