"""Nodes whose goals are contacts: their rules against a reimplementation in plain Python, and their behaviour."""

import itertools
import math

import numpy as np
import pytest

from neorl import Agent, Contacts, Desire, Learner, Node, Scene, WaterWorld, forager
from neorl.agents.forager import FOVEATED_CELL
from neorl.core.contacts import APPROACH, FEAR, VISITS
from neorl.core.modality import OBJECT_VECTOR_CELL
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
        if self.contacts.efference:
            pushed = velocity + self.contacts.efference * np.array(CARDINAL.pushes)
            return [(self.cells(thing, after)[0], 0) for after in pushed]
        cells, actions = self.cells(thing, velocity)
        return [(cells, action) for action in actions]

    def cells(self, thing, velocity):
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
        return [self.blend(cells, event, which) for cells, event in seen]

    def approaches(self, thing, velocity):
        """The approach of each action, float64 (actions,), as the mean over all moments of looking ahead."""
        moments = [self.values(self.seen(thing, velocity), APPROACH)]
        pushed = velocity + self.contacts.efference * np.array(CARDINAL.pushes)
        for steps in range(1, self.contacts.lookahead + 1):
            seen = [self.seen(thing - steps / 50 * after, after) for after in pushed]
            moments.append([self.discount**steps * max(self.values(each, APPROACH)) for each in seen])
        return np.mean(moments, axis=0)

    def learn(self, thing, seen_before, action, seen_now, met):
        cells, action = seen_before[action]
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


@pytest.mark.parametrize("contacts", [
    Contacts(), Contacts(familiarity=0.0, trace_rate=0.0, learning_rate=0.3), Contacts(efference=0.25),
    Contacts(efference=0.1, familiarity=30.0, trace_rate=0.5)])
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


@pytest.mark.parametrize("efference, lookahead", [(0.0, 0), (0.25, 0), (0.25, 1), (0.25, 3)])
@pytest.mark.parametrize("rivals", [0.0, 0.3, 1.0])
def test_the_best_thing_counts_in_full_and_each_other_by_its_share(efference, lookahead, rivals):
    contacts = Contacts(efference=efference, rivals=rivals, lookahead=lookahead)
    run = Run(forager([2, 5], 1.0, -1.0, contacts=contacts), WaterWorld(n_creeps=8), 4)
    run.advance(20_000)
    run.learns = False
    restated = Restated(contacts, (2, 5), 50)
    for number, n in enumerate((2, 5)):
        q = run.q(number)
        for cell in np.ndindex(n, n, n, n):
            for event in range(q.shape[1]):
                restated.known[(n, *cell), event] = q[sum(each * n**axis for axis, each in enumerate(cell)), event]
    for _ in range(200):
        scene = run.world_state.scene
        seen = [restated.seen((thing - scene.position) / 250, scene.velocity / 250) for thing in scene.things]
        greens = [restated.approaches((scene.things[k] - scene.position) / 250, scene.velocity / 250)
                  for k in np.flatnonzero(scene.kinds == 0)]
        fears = [restated.values(seen[k], FEAR) for k in np.flatnonzero(scene.kinds == 1)]
        expected = np.zeros(4) - contacts.caution * np.sum(fears, axis=0)
        if greens:
            expected += (1.0 - rivals) * max(greens, key=max) + rivals * sum(greens)
        run.advance(1)
        np.testing.assert_allclose(run.state.action_value, expected, atol=1e-6)


def test_two_actions_that_lead_to_one_after_state_have_one_value():
    learner = Learner(forager([25], 1.0, contacts=Contacts(efference=0.5)), things=1, kinds=("green", "red"), seed=1)
    begin = {"S": (1.0, 0.0), "E": (0.5, 0.5)}  # each leads to a velocity of (1, 0.5)
    scenes = {action: Scene((0.5, 0.5), velocity, [(0.9, 0.6)], (0,)) for action, velocity in begin.items()}
    learner.begin(scenes["S"])
    learner.observe(Scene((0.5, 0.5), None, [(0.2, 0.2)], (0,), (1,)), 1.0, action=CARDINAL.names.index("S"))
    for action, scene in scenes.items():
        learner.begin(scene)
        learner.act()
        values = dict(zip(CARDINAL.names, learner.state.action_value))
        assert values.pop(action) > max(values.values()) == np.float32(0.31)
    assert learner.q(0).shape == (25**4, 1, 3) and learner.q(0)[..., VISITS].sum() == 1


def test_cells_without_velocity_have_no_after_states():
    with pytest.raises(ValueError, match="efference with the node 'OVC' must be 0, since its cells have no axis"):
        Agent([Node("OVC", OBJECT_VECTOR_CELL, [4], goals="contacts")], contacts=Contacts(efference=0.25))


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
