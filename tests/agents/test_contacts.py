"""Nodes whose goals are contacts: their rules against a reimplementation in plain Python, and their behaviour."""

import itertools
import math

import numpy as np
import pytest

from neorl import Agent, Contacts, Desire, Learner, Node, Scene, WaterWorld, forager
from neorl.agents.forager import FOVEATED_CELL
from neorl.core.contacts import APPROACH, FEAR, VISITS
from neorl.core.scene import CARDINAL, Actions
from neorl.experiments.run import Run

MIRRORS = list(itertools.product((0, 1), (1, -1), (1, -1)))  # whether the axes are exchanged, and their signs


def image(vector, exchanged, sign_x, sign_y):
    x, y = sign_x * vector[0], sign_y * vector[1]
    return (y, x) if exchanged else (x, y)


class Restated:
    """The maps of a node as dictionaries, by the rules in the docstring of `neorl.core.contacts`."""

    def __init__(self, contacts, resolutions, fps):
        self.contacts, self.resolutions = contacts, resolutions
        self.discount = float(np.float32(contacts.horizon * fps / (1 + contacts.horizon * fps)))
        self.known = {}
        self.ways = {}

    def seen(self, thing, velocity):
        """The cell in each map, and the mirror image of each action."""
        candidates = []
        for each in MIRRORS:
            offset, speed = image(thing, *each), image(velocity, *each)
            if offset[0] >= offset[1] >= 0:
                candidates.append((offset, speed, [CARDINAL.pushes.index(tuple(map(int, image(push, *each))))
                                                   for push in CARDINAL.pushes]))
        offset, speed, actions = candidates[0]
        cells = []
        for n in self.resolutions:
            place = [min(int(math.sqrt(each) * n), n - 1) for each in offset]
            motion = [min(max(int(math.floor((each + 2.5) * n / 5.0)), 0), n - 1) for each in speed]
            cells.append((n, *place, *motion))
        return cells, actions

    def entry(self, cell, action):
        return self.known.setdefault((cell, action), [self.contacts.first_value, 0.0, 0])

    def blend(self, cells, action, which):
        value = self.entry(cells[0], action)[which]
        for cell in cells[1:]:
            own = self.entry(cell, action)
            if own[VISITS]:
                value += own[VISITS] / (own[VISITS] + self.contacts.familiarity) * (own[which] - value)
        return value

    def values(self, seen, which):
        cells, actions = seen
        return [self.blend(cells, action, which) for action in actions]

    def learn(self, thing, seen_before, action, seen_now, met):
        cells, actions = seen_before
        action = actions[action]
        approach = 1.0 if met else self.discount * max(self.values(seen_now, APPROACH))
        fear = 1.0 if met else self.discount * min(self.values(seen_now, FEAR))
        blends = [0.0, 0.0]
        for number, cell in enumerate(cells):
            entry = self.entry(cell, action)
            old, visits = list(entry[:2]), entry[VISITS]
            if number == 0:
                blends = list(old)
            elif visits == 0:
                old = list(blends)
            else:
                share = visits / (visits + self.contacts.familiarity)
                blends = [blend + share * (own - blend) for blend, own in zip(blends, old)]
            rate = max(self.contacts.learning_rate, (visits + 2) ** -0.75)
            entry[APPROACH] = old[0] + rate * (approach - old[0])
            entry[FEAR] = old[1] + rate * (fear - old[1])
            entry[VISITS] += 1
        way = self.ways.setdefault(thing, [])
        way.append([(cell, action) for cell in cells])
        if met:
            for number in range(len(self.resolutions)):
                worth = 1.0
                for step in way[-2:-65:-1]:
                    worth *= self.discount
                    entry = self.entry(*step[number])
                    entry[APPROACH] += self.contacts.trace_rate * max(0.0, worth - entry[APPROACH])
            self.ways[thing] = []


@pytest.mark.parametrize("contacts", [Contacts(), Contacts(familiarity=0.0, trace_rate=0.0, learning_rate=0.3)])
def test_the_maps_learn_as_the_rules_say(contacts):
    agent, world = forager([2, 5, 9], contacts=contacts), WaterWorld(n_creeps=8)
    run = Run(agent, world, 3)
    restated = Restated(contacts, (2, 5, 9), world.fps)

    def seen():
        scene = run.world_state.scene
        return [restated.seen((thing - scene.position) / world.width, scene.velocity / world.width)
                for thing in scene.things]

    before = seen()
    for _ in range(600):
        was_at = run.world_state.scene.position.copy()
        run.advance(1)
        scene, event, now = run.world_state.scene, int(run.state.last_event), seen()
        assert np.all(np.abs(scene.position - was_at) < 20)  # no episode has ended
        for thing in range(8):
            restated.learn(thing, before[thing], event, now[thing], scene.met[thing] != 0)
        before = now
    compared = 0
    for number, n in enumerate((2, 5, 9)):
        q = run.q(number)
        for ((resolution, *cell), action), (approach, fear, visits) in restated.known.items():
            if resolution == n:
                place = sum(each * n**axis for axis, each in enumerate(cell))
                if visits:
                    compared += 1
                    np.testing.assert_allclose(q[place, action], (approach, fear, visits), rtol=1e-5, atol=1e-6)
    assert compared > 100


def test_the_worth_of_things_is_learned_from_reward_and_unlearned():
    agent = forager([3])
    learner = Learner(agent, things=2, kinds=("green", "red"), seed=1)
    learner.begin(Scene((0.5, 0.5), None, [(0.2, 0.2), (0.8, 0.8)], (0, 1)))
    assert learner.state.desires.worth.tolist() == [1.0, 1.0]
    for pays in (-1.0, 1.0):
        for met in ((0, 1), (1, 0), (0, 1), (0, 0)) * 30:
            learner.act()
            learner.observe(Scene((0.5, 0.5), None, [(0.2, 0.2), (0.8, 0.8)], (0, 1), met),
                            reward=np.dot(met, (-pays, pays)))
        assert np.allclose(learner.state.desires.worth, (-pays, pays), atol=0.1)


def test_a_learned_worth_stays_when_the_agent_changes():
    run = Run(forager(), WaterWorld(), 2)
    run.advance(3_000)
    worth = run.state.desires.worth.copy()
    run.change(Agent([*run.agent.nodes, Node("more", FOVEATED_CELL, [3], goals="contacts")],
                     [*run.agent.desires, Desire("red", "more", 1.0)], contacts=run.agent.contacts))
    assert worth.tolist() == [1.0, -1.0] and run.state.desires.worth.tolist() == [1.0, -1.0, 1.0]


def test_a_world_without_the_mirror_images_of_its_actions_is_refused():
    with pytest.raises(ValueError, match="mirrored"):
        Learner(forager(), things=1, kinds=("green", "red"), actions=Actions(("E", "S"), ((1, 0), (0, 1))))
    with pytest.raises(ValueError, match="mirrored"):
        Learner(forager(), things=1, kinds=("green", "red"),
                actions=Actions(tuple("abcdef"), [(*each, 0) for each in ((1, 0), (-1, 0), (0, 1), (0, -1), (1, 1),
                                                                          (-1, -1))]))
