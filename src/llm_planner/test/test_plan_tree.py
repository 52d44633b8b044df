# SPDX-License-Identifier: Apache-2.0
"""How a plan is done: order, attempts, timeouts, hindrances, and breaking off."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from llm_planner.plan import Plan, Step
from llm_planner.plan_tree import make_tree, Progress, StepNews
from llm_planner.skills import SkillError, SkillRun
from llm_planner.skills_file import load_skills
from py_trees.common import Status

SKILLS = load_skills(Path(__file__).parents[1] / 'config' / 'skills.yaml')
PLAN = Plan('test', (Step('go_to', {'target': 'kitchen'}), Step('say', {'text': 'hello'})))


class World:
    """Skills that end as they are told, in a time that is set."""

    def __init__(self, *outcomes: Any, ticks: int = 2) -> None:
        self.outcomes, self.ticks = list(outcomes), ticks
        self.now_s, self.hindrance = 0.0, ''
        self.begun: list[str] = []
        self.undone: list[str] = []
        self.news: list[StepNews] = []
        self.progress = Progress(self.news.append)
        self.tree = make_tree(
            PLAN, SKILLS, self.start, lambda: self.hindrance, lambda: self.now_s, self.progress
        )

    def start(self, step: Step) -> SkillRun:
        """Begin a skill that ends as the next outcome says."""
        self.begun.append(step.skill)
        outcome = self.outcomes.pop(0) if self.outcomes else None
        has_ended = False
        try:
            for _ in range(self.ticks):
                yield
            has_ended = True
            if isinstance(outcome, SkillError):
                raise outcome
        finally:
            if not has_ended:
                self.undone.append(step.skill)

    def run(self, also: Callable[[int], None] = lambda _: None) -> Status:
        """Tick until it is over, and return how it ended."""
        for tick in range(100):
            also(tick)
            self.tree.tick_once()
            if self.tree.status != Status.RUNNING:
                break
        return self.tree.status

    @property
    def told(self) -> list[tuple[int, str]]:
        """Return what was told of each step."""
        return [(each.index, each.state) for each in self.news]


def test_steps_are_done_in_turn() -> None:
    """Each is told when it begins and ends."""
    world = World()
    assert world.run() == Status.SUCCESS
    assert world.begun == ['go_to', 'say'] and world.undone == []
    assert world.told == [(0, 'running'), (0, 'succeeded'), (1, 'running'), (1, 'succeeded')]
    assert world.news[0].text == 'go to the kitchen' and [
        index for index, state in world.told if state == 'succeeded'
    ] == [0, 1]


def test_a_failure_is_tried_again() -> None:
    """As often as the skill says; then the rest is left undone, with the last reason."""
    world = World(SkillError('First.'))
    assert world.run() == Status.SUCCESS and world.begun == ['go_to', 'go_to', 'say']
    world = World(SkillError('First.'), SkillError('Second.'))
    assert world.run() == Status.FAILURE and world.begun == ['go_to', 'go_to']
    assert str(world.progress.error) == 'Second.'
    assert world.told[-1] == (0, 'failed') and world.news[-1].text == 'Second.'


def test_a_final_failure_is_not_tried_again() -> None:
    """Where that makes no sense."""
    world = World(SkillError('Never.', is_final=True))
    assert world.run() == Status.FAILURE and world.begun == ['go_to']


def test_a_step_takes_no_longer_than_it_may() -> None:
    """By the time of the node; what goes on is undone."""
    world = World(ticks=1000)

    def hurry(tick: int) -> None:
        world.now_s = 50.0 * tick

    assert world.run(hurry) == Status.FAILURE
    assert world.progress.error is not None and world.progress.error.code == 'TIMEOUT'
    assert 'longer than 300 seconds to go to the kitchen' in str(world.progress.error)
    assert world.undone == ['go_to']


def test_time_that_goes_back_does_not_make_a_step_endless() -> None:
    """A simulation that begins anew gives it its whole time once more, and no more than that."""
    world = World(ticks=1000)
    times = iter([1000.0, 1000.0, 0.0, 100.0, 200.0, 299.0, 301.0, 302.0])
    status = world.run(lambda _: setattr(world, 'now_s', next(times)))
    assert status == Status.FAILURE and world.now_s == 301.0


def test_a_hindrance_ends_a_step_that_walks() -> None:
    """At once, and with the reason; what does not walk goes on."""
    world = World(ticks=5)

    def fall(tick: int) -> None:
        world.hindrance = 'The robot has fallen.' if tick >= 3 else ''

    assert world.run(fall) == Status.FAILURE
    assert str(world.progress.error) == 'The robot has fallen.' and world.undone == ['go_to']
    world = World(ticks=5)
    assert world.run(lambda tick: setattr(world, 'hindrance', 'x' * (tick > 7))) == Status.SUCCESS


def test_it_can_be_broken_off() -> None:
    """The step that runs is undone."""
    world = World()
    world.tree.tick_once()
    world.tree.stop(Status.INVALID)
    assert world.undone == ['go_to'] and world.begun == ['go_to']
