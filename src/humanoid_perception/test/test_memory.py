# SPDX-License-Identifier: Apache-2.0
"""Test what is remembered of a simulated world, and what is forgotten."""

from __future__ import annotations

import math

from humanoid_perception.memory import MemorySettings, ObjectMemory
from humanoid_perception.memory_testing import around, Box, BoxWorld, TABLE, WALL
from humanoid_perception.planar_poses import shift_between
from humanoid_perception.remembered import RememberedThing
from humanoid_perception.sighting import Sighting
import numpy as np
import pytest

MIDDLE = (0.0, 0.0, 0.75)
SEEDS = range(6)


def mug(x: float = 0.0, y: float = 0.0, colour: str = 'red') -> Box:
    """Return a mug on the table."""
    return Box('mug', (x, y, 0.75), colour=colour)


def watch(
    memory: ObjectMemory, world: BoxWorld, looks: int, radius: float = 1.3, **options
) -> None:
    """Look at the table from several sides."""
    for number in range(looks):
        view = world.view(around(MIDDLE, radius, 0.02 * number), MIDDLE)
        memory.look(view, world.sightings(view, **options))


def test_a_thing_is_believed_after_several_sightings() -> None:
    """Not before, so that one false detection is no thing."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 2)
    assert memory.things == []
    watch(memory, world, 1)
    (thing,) = memory.things
    assert thing.object_id == 'red_mug_1'
    assert (thing.class_id, thing.colour, thing.sightings) == ('mug', 'red', 3)
    assert 0.5 < thing.belief < 1.0


def test_scattered_false_detections_are_no_things() -> None:
    """Each is somewhere else."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL])
    random = np.random.default_rng(3)
    for number in range(100):
        view = world.view(around(MIDDLE, 1.3, 0.01 * number), MIDDLE)
        ghost = Sighting(
            'can', 0.6, np.array([*random.uniform(-0.5, 0.5, 2), 0.75]), np.full(3, 0.07)
        )
        memory.look(view, [ghost] if number % 2 else [])
    assert memory.things == []


def test_a_weak_detection_needs_more_sightings_than_a_strong_one() -> None:
    """Scores count."""
    counts = []
    for score in (0.9, 0.45):
        memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
        count = 0
        while not memory.things:
            watch(memory, world, 1, score=score)
            count += 1
        counts.append(count)
    assert counts[0] < counts[1]


def test_a_first_look_counts_once() -> None:
    """What is known after it is as unsure as that look, and two objects keep their mean score."""
    noise_m2 = np.diag((0.01, 0.02, 0.03))
    look = Sighting('mug', 0.9, np.array(MIDDLE), np.full(3, 0.1))
    thing = RememberedThing.of(look, noise_m2, 1.0, 0.5)
    assert thing.covariance_m2 == pytest.approx(noise_m2)
    assert (thing.sightings, thing.score) == (1, pytest.approx(0.9))
    for _ in range(2):
        thing.take(look, noise_m2, 2.0)
    other = RememberedThing.of(
        Sighting('mug', 0.5, np.array(MIDDLE), np.full(3, 0.1)), noise_m2, 1.0, 0.5
    )
    thing.absorb(other)
    assert (thing.sightings, thing.score) == (4, pytest.approx(0.8))


@pytest.mark.parametrize('seed', SEEDS)
def test_positions_come_closer_with_every_look(seed: int) -> None:
    """A far look says little, a near one much; the truth is within the stated uncertainty."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()], np.random.default_rng(seed))
    watch(memory, world, 10, radius=2.6)
    (thing,) = memory.things
    far_sigma = thing.sigma_m
    watch(memory, world, 15, radius=1.0)
    (same,) = memory.things
    error = np.linalg.norm(same.position_m - MIDDLE)
    assert same is thing
    assert error < 0.03
    assert same.sigma_m < far_sigma
    assert error < 4.0 * same.sigma_m


def test_looks_do_not_make_the_place_in_the_map_surer_than_that_of_the_robot() -> None:
    """Every look has the error of the robot's own pose; heights do not."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 60, radius=1.0)
    (thing,) = memory.things
    sigmas_m = np.sqrt(np.diag(thing.map_covariance_m2))
    assert thing.sigma_m < 0.03
    assert (sigmas_m[:2] > 0.04).all()
    assert sigmas_m[2] < 0.03


@pytest.mark.parametrize('seed', SEEDS)
def test_a_crowded_table_is_remembered_as_it_is(seed: int) -> None:
    """Neighbours are not mixed up; nothing is there twice."""
    random = np.random.default_rng(seed)
    kinds = ['mug', 'can', 'bottle', 'apple', 'cube', 'bowl']
    colours = ['red', 'blue', 'green']
    boxes = [
        Box(
            kinds[random.integers(6)],
            (0.17 * column, 0.17 * row, 0.75),
            (0.07, 0.07, 0.1),
            colours[random.integers(3)],
        )
        for row in range(-2, 3)
        for column in range(-2, 3)
        if random.random() < 0.6
    ]
    memory = ObjectMemory()
    world = BoxWorld([TABLE, WALL, *boxes], random)
    for number in range(40):
        view = world.view(around(MIDDLE, 2.4 - 0.04 * number, 0.05 * number, 1.5), MIDDLE)
        memory.look(view, world.sightings(view, chance=0.8))
    things = memory.things
    assert len(things) == len(boxes)
    for box in boxes:
        nearest = min(things, key=lambda thing: np.linalg.norm(thing.position_m - box.position))
        assert np.linalg.norm(nearest.position_m - box.position) < 0.05
        assert (nearest.class_id, nearest.colour) == (box.name, box.colour)
    assert len({thing.object_id for thing in things}) == len(things)


def test_things_out_of_view_are_kept() -> None:
    """For as long as one likes to look elsewhere."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    for _ in range(300):
        view = world.view((1.3, 0.0, 1.2), (3.0, 0.0, 1.0))
        memory.look(view, world.sightings(view))
    assert [thing.object_id for thing in memory.things] == ['red_mug_1']


def test_hidden_things_are_kept() -> None:
    """What stands before them hides them."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    world.boxes.append(Box('screen', (0.7, 0.0, 1.0), (0.02, 1.6, 1.2), '', False))
    for _ in range(100):
        view = world.view((1.6, 0.0, 1.1), MIDDLE)
        memory.look(view, world.sightings(view))
    assert [thing.object_id for thing in memory.things] == ['red_mug_1']


@pytest.mark.parametrize('with_depth', [True, False])
def test_a_thing_that_is_gone_is_forgotten(with_depth: bool) -> None:
    """After several looks, not after one; sooner where the depth shows that nothing is there."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 20)
    world.boxes.remove(world.boxes[-1])
    looks = 0
    while memory.things:
        view = world.view(around(MIDDLE, 1.3, 0.0), MIDDLE, depth=with_depth)
        memory.look(view, world.sightings(view))
        looks += 1
    assert (4 <= looks <= 10) if with_depth else (10 <= looks <= 30)


def test_a_thing_that_the_detector_overlooks_stays_for_long() -> None:
    """The depth shows that something is where it was."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 20)
    watch(memory, world, 50, chance=0.0)
    assert [thing.object_id for thing in memory.things] == ['red_mug_1']


def test_a_turning_camera_forgets_nothing() -> None:
    """Its pictures are blurred, and its pose is late."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 20)
    world.boxes.pop()
    for _ in range(50):
        view = world.view(around(MIDDLE, 1.3, 0.0), MIDDLE, turn_rad_s=1.5)
        memory.look(view, [])
    assert len(memory.things) == 1


@pytest.mark.parametrize('distance', [0.25, 0.5])
def test_a_thing_that_was_carried_elsewhere_keeps_its_id(distance: float) -> None:
    """There is one such mug, before and after."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 20)
    world.boxes[-1] = mug(0.0, distance)
    watch(memory, world, 25)
    (thing,) = memory.things
    assert thing.object_id == 'red_mug_1'
    assert np.linalg.norm(thing.position_m - [0.0, distance, 0.75]) < 0.03


def test_a_thing_that_is_pushed_is_followed() -> None:
    """Slowly, over the table."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    for number in range(60):
        world.boxes[-1] = mug(0.0, 0.008 * number)
        watch(memory, world, 1)
    watch(memory, world, 5)
    (thing,) = memory.things
    assert thing.object_id == 'red_mug_1'
    assert abs(thing.position_m[1] - 0.472) < 0.05


def test_a_second_one_of_a_kind_gets_the_next_number() -> None:
    """Ids are stable, and never given twice."""
    memory, world = (
        ObjectMemory(),
        BoxWorld([TABLE, WALL, mug(), mug(0.0, 0.3), mug(0.0, -0.3, '')]),
    )
    watch(memory, world, 10)
    ids = sorted(thing.object_id for thing in memory.things)
    assert ids == ['mug_1', 'red_mug_1', 'red_mug_2']


def test_two_names_for_one_thing_make_one_thing() -> None:
    """A detector that says ball and orange at once; the surer name wins."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL])
    size = np.full(3, 0.07)
    world.boxes.append(Box('orange', MIDDLE, (0.07, 0.07, 0.07), 'orange'))
    for _ in range(15):
        view = world.view((1.3, 0.0, 1.2), MIDDLE)
        spot = np.array(MIDDLE) + world.random.normal(0.0, 0.004, 3)
        memory.look(
            view, [Sighting('orange', 0.8, spot, size), Sighting('ball', 0.4, spot + 0.005, size)]
        )
    (thing,) = memory.things
    assert thing.class_id == 'orange'
    assert thing.class_score < 0.8


def test_the_class_is_that_of_most_looks() -> None:
    """What was wrong at first comes right."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, Box('can', MIDDLE)])
    watch(memory, world, 4)
    world.boxes[-1] = mug()
    watch(memory, world, 30)
    (thing,) = memory.things
    assert thing.class_id == 'mug'
    assert thing.object_id == 'red_can_1'


def test_what_the_border_cuts_does_not_move_the_thing() -> None:
    """It is seen, but neither its position nor its size is."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    (thing,) = memory.things
    before, size, count = thing.position_m.copy(), thing.size_m.copy(), thing.sightings
    for _ in range(10):
        view = world.view((1.3, 0.0, 1.2), (0.0, 0.8, 0.75))
        half = Sighting('mug', 0.7, np.array([0.0, 0.02, 0.75]), np.full(3, 0.04), is_cut=True)
        memory.look(view, [half])
    (thing,) = memory.things
    assert np.array_equal(thing.position_m, before)
    assert np.array_equal(thing.size_m, size)
    assert thing.sightings == count + 10


def test_what_is_only_ever_seen_cut_is_no_thing() -> None:
    """Nobody knows where it is."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL])
    for _ in range(20):
        view = world.view((1.3, 0.0, 1.2), MIDDLE)
        memory.look(view, [Sighting('mug', 0.9, np.array(MIDDLE), np.full(3, 0.1), is_cut=True)])
    assert memory.things == []


@pytest.mark.parametrize(
    'bad',
    [
        Sighting('mug', 0.9, np.array([np.nan, 0.0, 0.7]), np.full(3, 0.1)),
        Sighting('mug', 0.9, np.array([0.0, np.inf, 0.7]), np.full(3, 0.1)),
        Sighting('mug', np.nan, np.array(MIDDLE), np.full(3, 0.1)),
        Sighting('mug', 0.9, np.array(MIDDLE), np.zeros(3)),
        Sighting('mug', 0.9, np.array(MIDDLE), np.array([1e-16, np.nan, 0.1])),
        Sighting('mug', 0.9, np.array(MIDDLE), np.full(3, 80.0)),
        Sighting('', 0.9, np.array(MIDDLE), np.full(3, 0.1)),
    ],
)
def test_unsound_detections_are_left_out(bad: Sighting) -> None:
    """They spoil nothing."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    for _ in range(10):
        view = world.view((1.3, 0.0, 1.2), MIDDLE)
        memory.look(view, [bad, *world.sightings(view)])
    (thing,) = memory.things
    assert np.isfinite(thing.position_m).all()


def test_sizes_are_those_of_near_looks() -> None:
    """Far away, boxes are too large."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL])
    for radius, size in ((2.8, 0.2), (0.9, 0.1)):
        for _ in range(10):
            view = world.view(around(MIDDLE, radius, 0.0), MIDDLE)
            spot = np.array(MIDDLE) + world.random.normal(0.0, 0.004, 3)
            memory.look(view, [Sighting('mug', 0.8, spot, np.full(3, size))])
    (thing,) = memory.things
    assert thing.size_m == pytest.approx(np.full(3, 0.1), abs=0.015)


def test_a_corrected_position_of_the_robot_moves_what_was_seen_by_the_wrong_one() -> None:
    """It turns with the map's view of the odometry; what was seen by another one stays."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    for _ in range(5):
        view = world.view((1.3, 0.0, 1.2), MIDDLE)
        memory.look(view, world.sightings(view))
    (first,) = memory.things
    before = first.position_m.copy()
    wrong = (0.5, 0.2, math.radians(20))
    away = world.view((0.0, 0.0, 1.2), (3.0, 0.0, 1.2))
    for number in range(21):
        memory.look(away, [], tuple(each * number / 20 for each in wrong))
    world.boxes[-1] = Box('can', (0.0, 0.3, 0.75), colour='blue')
    for _ in range(5):
        view = world.view((1.3, 0.1, 1.2), (0.0, 0.3, 0.75), turn_rad_s=1.0)
        memory.look(view, world.sightings(view), wrong)
    can = next(thing for thing in memory.things if thing.class_id == 'can')
    place = can.position_m.copy()
    memory.look(away, [], (0.0, 0.0, 0.0))
    assert np.array_equal(first.position_m, before)
    c, s = math.cos(-wrong[2]), math.sin(-wrong[2])
    x, y = place[0] - wrong[0], place[1] - wrong[1]
    assert can.position_m[:2] == pytest.approx([c * x - s * y, s * x + c * y], abs=1e-9)


def test_small_corrections_move_nothing() -> None:
    """Drift is corrected bit by bit; what was seen stays where it was."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    for number in range(40):
        view = world.view((1.3, 0.0, 1.2), MIDDLE)
        memory.look(view, world.sightings(view), (0.01 * number, 0.0, 0.0))
    (thing,) = memory.things
    assert np.linalg.norm(thing.position_m - MIDDLE) < 0.03


@pytest.mark.parametrize(('correction', 'count'), [((0.0, 0.0, 0.0), 2), ((0.14, 0.0, 0.0), 1)])
def test_what_a_correction_displaces_is_no_second_thing(
    correction: tuple[float, float, float], count: int
) -> None:
    """A mug beside where one was is that one, if the robot was mistaken about where it stands."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    world.boxes[-1] = mug(x=0.25)
    for _ in range(5):  # a turning camera does not show that the old place is empty
        view = world.view((1.3, 0.0, 1.2), MIDDLE, turn_rad_s=0.6)
        memory.look(view, world.sightings(view), correction)
    assert len(memory.things) == count


@pytest.mark.parametrize('seed', SEEDS)
def test_a_shift_takes_one_pose_to_the_other(seed: int) -> None:
    """A point that is fixed in the frame that moved moves with it."""
    random = np.random.default_rng(seed)
    old, new = (tuple(random.uniform(-3, 3, 3)) for _ in range(2))
    point = random.uniform(-2, 2, 2)

    def seen(pose, at):
        c, s = math.cos(pose[2]), math.sin(pose[2])
        return np.array([pose[0] + c * at[0] - s * at[1], pose[1] + s * at[0] + c * at[1]])

    assert seen(shift_between(old, new), seen(old, point)) == pytest.approx(seen(new, point))


def test_memory_is_bounded() -> None:
    """However many things are detected."""
    memory = ObjectMemory(MemorySettings(max_things=50))
    world = BoxWorld([])
    random = np.random.default_rng(5)
    for _ in range(60):
        view = world.view((0.0, 0.0, 1.2), (1.0, 0.0, 1.0), turn_rad_s=1.0)
        spots = random.uniform(-20.0, 20.0, (30, 3))
        memory.look(view, [Sighting('can', 0.9, spot, np.full(3, 0.1)) for spot in spots])
        assert len(memory.things) + memory.tentative_count <= 50


def test_clearing_begins_anew() -> None:
    """Numbers of ids too."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 5)
    memory.clear()
    assert memory.things == []
    world.time_s = 0.0
    watch(memory, world, 5)
    assert [thing.object_id for thing in memory.things] == ['red_mug_1']


def test_everything_can_be_expressed_in_another_frame() -> None:
    """As when a map appears."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug(0.3, 0.0)])
    watch(memory, world, 10)
    memory.move_all((1.0, 2.0, math.pi / 2))
    (thing,) = memory.things
    assert thing.position_m == pytest.approx([1.0, 2.3, 0.75], abs=0.03)
    assert thing.yaw_rad == pytest.approx(math.pi / 2)


def test_what_a_hand_holds_goes_along_with_it() -> None:
    """Without being seen, without a double, and it stays where the hand lets it go."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    there = np.array([0.3, -0.2, 0.75])
    for share in np.linspace(0.0, 1.0, 20):
        at = (1.0 - share) * np.array(MIDDLE) + share * there
        world = BoxWorld([TABLE, WALL, mug(*at[:2])], time_s=world.time_s)
        view = world.view(around(MIDDLE, 1.3, 0.0), MIDDLE)
        seen = world.sightings(view) if share < 0.5 else []
        memory.look(view, seen, held_m={'red_mug_1': at})
        (thing,) = memory.things
        assert thing.position_m == pytest.approx(at)
    watch(memory, world, 10)
    (thing,) = memory.things
    assert thing.object_id == 'red_mug_1'
    assert memory.tentative_count == 0
    assert np.linalg.norm(thing.position_m - there) < 0.03


def test_what_nobody_knows_in_a_hand_is_no_thing() -> None:
    """Such as what a hand took that was started anew."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    for number in range(10):
        view = world.view(around(MIDDLE, 1.3, 0.02 * number), MIDDLE)
        memory.look(view, world.sightings(view), held_m={'something': np.array(MIDDLE)})
    assert memory.things == []


def test_own_hands_are_no_things() -> None:
    """What is detected there is left out, and what was there before stays."""
    memory, world = ObjectMemory(), BoxWorld([TABLE, WALL, mug()])
    watch(memory, world, 10)
    for number in range(100):
        view = world.view(around(MIDDLE, 1.3, 0.002 * number), MIDDLE)
        hand = Sighting('cube', 0.9, np.array([0.05, 0.05, 0.8]), np.full(3, 0.05), colour='black')
        memory.look(view, [hand], hands_m=[np.array([0.02, 0.02, 0.8])])
    assert [each.object_id for each in memory.things] == ['red_mug_1']
    assert memory.tentative_count == 0
