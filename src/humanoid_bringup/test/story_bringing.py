# SPDX-License-Identifier: Apache-2.0
"""Twenty stories of taking, bringing and putting down, in the simulated home: `make stories`."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
import math
from pathlib import Path

from humanoid_bringup.stories import (
    AS_ASKED,
    Check,
    CheckInput,
    EXPLAINED,
    Play,
    stays,
    Story,
    tell_all,
)
from humanoid_bringup.testing import ToldRobot
from humanoid_common.testing.launching import running_launch_file
from humanoid_common.testing.ros import ros_sandbox
from humanoid_simulation.scene import load_scene
import pytest

LAUNCH_FILE = Path(__file__).parents[1] / 'launch' / 'full_system.launch.py'
SPEECH = Path(__file__).parents[2] / 'voice_control' / 'test' / 'speech'
THINGS = {thing.name: thing for thing in load_scene('apartment').objects}
LEAST = 16
PULL_N, PULL_S, OUT_S, AGAIN_S = 12.0, 0.5, 8.0, 3.0
"""How hard and how long somebody pulls, when a hand is held out, and how soon they try again."""

pytestmark = pytest.mark.timeout(7200)


def is_held(told: ToldRobot, name: str) -> bool:
    """Whether a thing truly is before the robot, above all that it could stand on."""
    x, y, z = told.entities.position_m(name)
    return z > 0.6 and abs(complex(x, y) - told.robot.pose.position_m) < 0.8


def is_upright_on(scene: CheckInput, name: str, surface: str) -> bool:
    """Whether a thing truly stands on a surface, upright."""
    x, y, z = scene.told.entities.position_m(name)
    bottom_m = z - 0.5 * THINGS[name].box_m[2]
    places = scene.told.places
    top_m = next(each.height_m for each in places.surfaces if each.name == surface)
    # what lies has its middle lower
    return places.surface_at(x, y, bottom_m) == surface and abs(bottom_m - top_m) < 0.02


def held(name: str) -> Check:
    """Check that the robot holds a thing."""
    return lambda scene: scene.told.has_succeeded and is_held(scene.told, name)


def stands_on(name: str, surface: str) -> Check:
    """Check that a thing truly stands somewhere, upright."""
    return lambda scene: scene.told.has_succeeded and is_upright_on(scene, name, surface)


def tidied(surface: str, moved: Sequence[str], left: str) -> Check:
    """Check that things truly stand where they were carried, and that it is told what is left."""
    return lambda scene: (
        all(is_upright_on(scene, name, surface) for name in moved)
        and f'The {left} is still there.' in scene.said
    )


def lies_in(name: str, container: str) -> Check:
    """Check that a thing truly has fallen into a container."""

    def check(scene: CheckInput) -> bool:
        x, y, z = scene.told.entities.position_m(name)
        places = scene.told.places.surfaces
        rim = next(each for each in places if each.name == container)
        return scene.told.has_succeeded and rim.distance_m((x, y)) == 0.0 and z < rim.height_m

    return check


def handed(name: str) -> Check:
    """Check that somebody has got a thing."""
    return lambda scene: scene.told.has_succeeded and not is_held(scene.told, name)


def brought(name: str) -> Check:
    """Check that somebody has got a thing where they asked for it."""
    return lambda scene: handed(name)(scene) and abs(scene.moved_m) < 0.6


def take(name: str) -> Play:
    """Pull at a thing that is held out, until the robot lets go."""

    def play(told: ToldRobot) -> None:
        told.wait_until(lambda: 'Here you are.' in told.said or told.is_over, 600.0, 'a hand')
        told.robot.wait(OUT_S)
        assert told.is_over or is_held(told, name), (
            f'It holds out an empty hand: {told.entities.position_m(name)}'
        )
        while not told.is_over:
            yaw_rad = told.robot.pose.yaw_rad
            ahead = (PULL_N * math.cos(yaw_rad), PULL_N * math.sin(yaw_rad), 0.0)
            told.entities.pull(name, ahead, PULL_S)
            told.robot.wait(AGAIN_S)

    return play


def stop_when_held(name: str) -> Play:
    """Say stop when the robot has a thing in its hand, and walks."""

    def play(told: ToldRobot) -> None:
        told.wait_until(lambda: 'I am coming back.' in told.said or told.is_over, 600.0, 'a way')
        told.robot.wait(4.0)
        told.tell('stop')
        told.wait_for('I have stopped.', 60.0)

    return play


STORIES = (
    Story(
        'bringing',
        'bring me the red mug from the kitchen',
        brought('red_mug'),
        SPEECH / 'bring_me_the_red_mug_from_the_kitchen.rms.wav',
        play=take('red_mug'),
    ),
    Story(
        'bringing', 'bring me the green apple', brought('green_apple'), play=take('green_apple')
    ),
    Story('taking', 'pick up the blue mug', held('blue_mug')),
    Story('asking', 'where is the blue mug', lambda s: s.said == 'I am holding the blue mug.'),
    Story('putting', 'put it on the kitchen counter', stands_on('blue_mug', 'kitchen_counter')),
    Story('refusing', 'take the white bowl', lambda s: 'too wide' in s.said),
    Story(
        'putting',
        'put the green bottle on the kitchen table',
        stands_on('green_bottle', 'kitchen_table'),
    ),
    Story('taking', 'take the red can', held('red_can')),
    Story(
        'refusing',
        'pick up the yellow can',
        stays('my hand would not be empty.'),
    ),
    Story('putting', 'put it on the kitchen table', stands_on('red_can', 'kitchen_table')),
    Story('putting', 'put the yellow can into the bin', lies_in('yellow_can', 'kitchen_bin')),
    Story('bringing', 'fetch the yellow mug', brought('yellow_mug'), play=take('yellow_mug')),
    Story(
        'bringing',
        'bring me the blue bottle',
        lambda s: 'Nobody took it.' in s.said and is_held(s.told, 'blue_bottle'),
    ),
    Story('putting', 'put it on the coffee table', stands_on('blue_bottle', 'coffee_table')),
    Story(
        'tidying',
        'tidy up the coffee table',
        tidied('kitchen_counter', moved=('blue_bottle', 'red_apple'), left='blue book'),
        within_s=1800.0,
    ),
    Story(
        'together',
        'go to the bedroom and bring me the yellow cube',
        handed('yellow_cube'),
        play=take('yellow_cube'),
    ),
    Story('bringing', 'bring me the blue can', brought('blue_can'), play=take('blue_can')),
    Story(
        'stopping',
        'bring me the pink mug',
        lambda s: s.said.endswith('I have stopped.') and is_held(s.told, 'pink_mug'),
        play=stop_when_held('pink_mug'),
    ),
    Story(
        'giving',
        'hand it over',
        handed('pink_mug'),
        play=take('pink_mug'),
    ),
    Story(
        'refusing',
        'bring me the unicorn',
        stays('I did not understand "bring me the unicorn".'),
    ),
)


@pytest.fixture(scope='module')
def told() -> Iterator[ToldRobot]:
    """Start everything, without the page."""
    arguments = ('gui:=false', 'audio:=none', 'real_time_factor:=0.7')
    with ros_sandbox() as ros, running_launch_file(LAUNCH_FILE, *arguments):
        yield ToldRobot(ros)


def test_twenty_stories(told: ToldRobot, capsys: pytest.CaptureFixture[str]) -> None:
    """Most end as asked, the others with an explanation; the robot never falls."""
    ends = tell_all(told, STORIES, capsys)
    assert {AS_ASKED, EXPLAINED}.issuperset(ends)
    assert ends.count(AS_ASKED) >= LEAST
