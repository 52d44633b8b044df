# SPDX-License-Identifier: Apache-2.0
"""The home in physics: what rests costs nothing, and wakes when something happens to it."""

from __future__ import annotations

from humanoid_simulation.backend import EntityState, MujocoBackend
from humanoid_simulation.scene import load_scene
import numpy as np
import pytest

LEVEL = np.array([1.0, 0.0, 0.0, 0.0])


@pytest.fixture
def home(make_backend) -> MujocoBackend:
    """Return the apartment after two seconds."""
    backend = make_backend(scene=load_scene('apartment'))
    run(backend, 2.0)
    return backend


def run(backend: MujocoBackend, seconds: float) -> None:
    """Let time pass."""
    for _ in range(round(seconds / backend.period_s)):
        backend.step({})


def awake(backend: MujocoBackend) -> int:
    """Return how many robots and things the physics computes."""
    return int(np.count_nonzero(backend.data.tree_awake))


def test_things_stay_where_the_file_puts_them(home: MujocoBackend) -> None:
    """Nothing falls, rolls away or jumps; the robot alone is awake."""
    for thing in load_scene('apartment').objects:
        moved_m = home.entity_state(thing.name).position_m - thing.position_m
        assert np.abs(moved_m).max() < 0.005, thing.name
    assert awake(home) == 1


def test_a_thing_that_is_put_into_the_air_falls(home: MujocoBackend) -> None:
    """It wakes, comes to rest where it was, and sleeps again."""
    there_m = home.entity_state('red_mug').position_m
    home.set_entity_state('red_mug', EntityState(there_m + np.array([0.0, 0.0, 0.3]), LEVEL))
    run(home, 0.1)
    assert awake(home) == 2
    assert home.entity_state('red_mug').position_m[2] < there_m[2] + 0.3 - 0.03
    run(home, 2.0)
    assert home.entity_state('red_mug').position_m == pytest.approx(there_m, abs=0.005)
    assert awake(home) == 1


def test_a_push_wakes_a_thing(home: MujocoBackend) -> None:
    """A bottle that is pushed moves."""
    there_m = home.entity_state('green_bottle').position_m
    home.apply_wrench('green_bottle', (3.0, 0.0, 0.0), duration_s=0.1)
    run(home, 0.5)
    assert home.entity_state('green_bottle').position_m[0] > there_m[0] + 0.05


def test_what_stands_on_a_thing_falls_when_that_is_taken_away(home: MujocoBackend) -> None:
    """Also if both were asleep."""
    book_m = home.entity_state('blue_book').position_m
    above = EntityState(book_m + np.array([0.0, 0.0, 0.06]), LEVEL)
    home.set_entity_state('green_cube', above)
    run(home, 3.0)
    on_book_m = home.entity_state('green_cube').position_m[2]
    assert awake(home) == 1
    home.set_entity_state('blue_book', EntityState(np.array([0.0, 0.0, 3.0]), LEVEL))
    run(home, 1.0)
    assert home.entity_state('green_cube').position_m[2] < on_book_m - 0.02


def test_a_reset_puts_everything_back(home: MujocoBackend) -> None:
    """Also what slept elsewhere."""
    home.set_entity_state('red_ball', EntityState(np.array([0.0, 0.3, 0.05]), LEVEL))
    run(home, 2.0)
    home.reset()
    run(home, 1.0)
    wanted_m = load_scene('apartment').thing('red_ball').position_m
    assert home.entity_state('red_ball').position_m == pytest.approx(wanted_m, abs=0.005)


def test_the_same_steps_lead_to_the_same_world(make_backend) -> None:
    """Bit for bit, with things that sleep and wake."""

    def after() -> np.ndarray:
        backend = make_backend(scene=load_scene('apartment'))
        run(backend, 1.0)
        backend.apply_wrench('red_can', (2.0, 1.0, 0.0), duration_s=0.1)
        run(backend, 1.0)
        return backend.snapshot().qpos

    assert np.array_equal(after(), after())


def test_things_weigh_what_a_hand_can_lift() -> None:
    """From 50 g to a kilogram, and they fit between fingers or two hands."""
    for thing in load_scene('apartment').objects:
        assert 0.05 <= thing.mass_kg <= 1.0, thing.name
        assert min(thing.box_m) <= 0.1 and max(thing.box_m) <= 0.3, thing.name
