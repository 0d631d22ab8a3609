"""An agent embodied in one world: the record and the flat arrays that the kernels take.

The agent depends on a world only through its `size`, `fps`, `kinds`, `actions` and the number of its `things`: see
`neorl.worlds.world`. The kinds in its desires are matched by name here.
"""

import itertools

import numpy as np

from neorl.agents.agent import FIRST_WORTH, LEARNED, Place
from neorl.common import checks
from neorl.core import contacts, displacement, loop
from neorl.core.building import choices_of, new_agent
from neorl.core.choices import Credit, MapState, Source, UpdateOn, Weighting
from neorl.core.coordinates import as_turns
from neorl.core.functions import AgentFunctions, Loop, UserFunctions, choice, features, no_credit
from neorl.core.policy import greedy
from neorl.worlds.former import check_present

OF_SELF = displacement.begin_self, displacement.observe_self
OF_CONTACTS = contacts.begin_contacts, contacts.observe_contacts, contacts.evaluate_contacts
TRACE_STEPS = 64  # of the trace behind a contact; the contact's value, discounted over 1.3 s, is small


def embodied(agent, world):
    """The record of an agent in a world, and its `neorl.core.layout.Memory` as yet without values.

    Raises ValueError if the agent desires something that the world lacks, or has cells that have no meaning there.
    """
    return new_agent(choices_in(agent, world), world.things)


def loop_of(agent, whole=False):
    """The `Loop` of an agent: the kernels that it calls, and None for others unless it is to be whole."""
    credit, axes = agent.learning.credit, own_axes(agent)
    check_present(credit, agent.policy.choose, *axes)
    of_self = whole or any(node.state != "object" for node in agent.nodes)
    of_contacts = whole or any(node.goals == "contacts" for node in agent.nodes)
    user = UserFunctions(features(*axes) if whole or axes else None,
                         credit if callable(credit) else no_credit if whole else None,
                         choice(agent.policy.choose) if whole or agent.policy.choose is not greedy else None)
    functions = AgentFunctions(user, *(OF_SELF if of_self else [None] * len(OF_SELF)),
                               *(OF_CONTACTS if of_contacts else [None] * len(OF_CONTACTS)))
    return Loop(functions, loop.begin, loop.act, loop.observe)


def own_axes(agent):
    """The user-defined kernels among the axes of an agent, in the order of their numbers."""
    return tuple(function for node in agent.nodes for function in node.modality.functions)


def choices_in(agent, world):
    """What the record of an agent in a world is made of, see `neorl.core.building`."""
    _check_meeting(agent, world)
    names, actions = [node.name for node in agent.nodes], world.actions
    nodes = [choices | {
        "learns_contacts": node.goals == "contacts", "state": MapState[node.state.replace(" ", "_")],
        "ends": node.beyond == "none", "reach": node.reach, "weighting": Weighting[node.weighting], "gain": node.gain,
        "resolutions": node.resolutions} for node, choices in zip(agent.nodes, choices_of(
            [node.modality for node in agent.nodes]))]
    mirrored = [node.modality.name for node in agent.nodes if node.modality.mirrored]
    frames = (_frames(actions, mirrored[0]) if mirrored else
              np.arange(len(actions.names), dtype=np.int64).reshape(1, -1))
    return {
        "size": float(world.size), "own_cell_counts": agent.own_cell == "counts",
        "shared_cell_counts_once": agent.shared_cell == "once", "notices_resets": agent.resets == "noticed",
        "learns": True,
        "push": np.array(actions.pushes, float), "frames": frames,
        "nodes": nodes, "order": [names.index(name) for name in agent.evaluation_order],
        "desires": [_desire(agent, world, desire, names) for desire in agent.desires],
        "learning": _learning(agent.learning, world.fps), "contacts": _contacts(agent, world.fps, len(actions.names)),
        "policy": {"exploration": agent.policy.exploration,
                   "indifferent_is_no_op": agent.policy.when_indifferent == "no-op",
                   "is_greedy": agent.policy.choose is greedy, "last": len(actions.all_names) - 1}}


def _check_meeting(agent, world):
    n_axes, kinds = world.actions.axes, tuple(world.kinds)
    for node in agent.nodes:
        if node.name in kinds:
            raise checks.error("name of a node", f"other than the kinds of this world's things, {checks.either(kinds)}",
                               node.name)
        node.modality.check_axes(n_axes)
        if (node.state != "object" or node.reach > 0) and len(node.modality.axes) != n_axes:
            raise ValueError(f"node {node.name!r} must have {n_axes} components in this world, with the state "
                             f"{node.state!r} and a reach of {node.reach}, but has {len(node.modality.axes)}")
    for desire in agent.desires:
        if isinstance(desire.source, str) and not agent.comes_from_node(desire) and desire.source not in kinds:
            raise checks.error(f"source of the desire {desire}", "a node of the agent or a kind of this world's "
                               f"things, {checks.either(kinds)}", desire.source)
        if isinstance(desire.source, Place) and len(desire.source.coordinates) != n_axes:
            raise checks.error(f"source of the desire {desire}", f"a place of {n_axes} coordinates in this world",
                               desire.source)
        if (isinstance(desire.source, Place) and getattr(world, "bounded", False)  # the surroundings of a Learner
                and not all(0 <= coordinate <= 1 for coordinate in desire.source.coordinates)):
            raise checks.error(f"source of the desire {desire}", "a place on the board", desire.source,
                               "give coordinates from 0 to 1, in units of its width")
    if agent.policy.when_indifferent == "no-op" and world.actions.idle is None:
        raise checks.error("when_indifferent", "'random' in a world without an idle action",
                           agent.policy.when_indifferent)


def _desire(agent, world, desire, names):
    """The choices of a desire. names: of the nodes."""
    source, target, place, point = desire.source, names.index(desire.target), [0.0] * world.actions.axes, []
    if isinstance(source, Place):
        kind, place = Source.place, source.coordinates
    elif not isinstance(source, str):
        kind, point = Source.point, as_turns(agent.nodes[target].modality, source)[0].tolist()
    else:
        kind = Source.node if agent.comes_from_node(desire) else Source.kind
    return {"source": kind, "kind": world.kinds.index(source) if source in world.kinds else -1, "target": target,
            "valence": FIRST_WORTH if desire.valence == LEARNED else desire.valence or 0.0,
            "learned": desire.valence == LEARNED, "sums_valence": desire.valence is None, "scale": desire.scale,
            "signed": desire.signed, "place": place, "point": point,
            "elements": [e for e, other in enumerate(agent.desires)
                         if source == other.target and (not desire.of or other.source in desire.of)]}


def _learning(learning, fps):
    return {"learning_rate": np.float32(learning.learning_rate),
            "discount": np.float32(learning.discount),
            "absent_decay": np.float32(learning.absent_decay),
            "away": learning.absent_form == "away",
            "update_on": int(UpdateOn[learning.update_on]),
            "credit": int(Credit.own if callable(learning.credit) else Credit[learning.credit]),
            "activity_retained": _retained(learning.activity * fps),
            "terminal": learning.terminal,
            "memory_retained": _retained(learning.memory),
            "bootstrap": learning.bootstrap}


def _contacts(agent, fps, actions):
    contacts, learns = agent.contacts, any(node.goals == "contacts" for node in agent.nodes)
    return {"discount": float(_retained(contacts.horizon * fps)), "learning_rate": contacts.learning_rate,
            "familiarity": contacts.familiarity, "first_value": contacts.first_value,
            "trace": TRACE_STEPS if learns else 1, "trace_rate": contacts.trace_rate, "caution": contacts.caution,
            "flees": contacts.fear == "avoidance", "rivals": contacts.rivals, "efference": contacts.efference,
            "after_states": actions if learns and contacts.efference > 0 else 0, "lookahead": contacts.lookahead,
            "step": 1.0 / fps}


def _frames(actions, name):
    """The action that each action becomes in each mirror image, as `neorl.core.contacts.mirror` numbers them."""
    frames = []
    exchanges = itertools.product(*(range(actions.axes - axis) for axis in reversed(range(actions.axes - 1))))
    for far, flips in itertools.product(exchanges, itertools.product((1, -1), repeat=actions.axes)):
        pushes = np.array(actions.pushes) * flips[::-1]
        for axis, other in enumerate(reversed(far)):
            pushes[:, [axis, axis + other]] = pushes[:, [axis + other, axis]]
        frames.append([_action_of(actions, push, name) for push in pushes])
    return np.array(frames, np.int64)


def _action_of(actions, push, name):
    for action, its_push in enumerate(actions.pushes):
        if tuple(push) == its_push:
            return action
    raise ValueError(f"{name}s must not be mirrored in this world: none of its actions pushes by "
                     f"{tuple(map(float, push))}, the mirror image of one that does")


def _retained(constant):
    """The share that remains after one step, or change, of a decay with this time constant in steps, or changes."""
    return np.float32(constant / (1.0 + constant))
