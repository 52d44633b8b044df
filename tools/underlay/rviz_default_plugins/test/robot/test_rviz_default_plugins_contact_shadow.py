# SPDX-License-Identifier: Apache-2.0
"""The shadow below a robot."""

from __future__ import annotations

from typing import Any

import pytest
from rviz_common.frames import Pose
from rviz_common.visualizer.surroundings import CONTACTS
from rviz_default_plugins.robot.contact_shadow import ContactShadow
from stage import Stage

PATH = f'{CONTACTS}/%2Frobot'


@pytest.fixture
def shadow(stage: Stage) -> Any:
    """Return a shadow, which nothing throws yet."""
    shadow = ContactShadow(stage.context.scene, '/robot')
    yield shadow
    shadow.remove()


def test_it_is_below_the_robot(stage: Stage, shadow: ContactShadow) -> None:
    """It is on the ground, as wide as the robot is high, and moves only if that can be seen."""
    assert stage.node_at(PATH) is None
    shadow.place(Pose((1.0, 2.0, 0.8)))
    disc = stage.node_at(PATH)
    assert disc.position.tolist() == pytest.approx([1.0, 2.0, 0.004])
    assert disc.scale == pytest.approx(0.48)
    shadow.place(Pose((1.005, 2.0, 0.79)))
    assert disc.position[0] == 1.0
    shadow.place(Pose((1.5, 2.0, 0.8)))
    assert disc.position[0] == 1.5


def test_one_that_has_fallen_keeps_its_shadow(stage: Stage, shadow: ContactShadow) -> None:
    """It is not smaller, though the robot is lower now."""
    shadow.place(Pose((0.0, 0.0, 0.8)))
    shadow.place(Pose((1.0, 0.0, 0.1)))
    assert stage.node_at(PATH).scale == pytest.approx(0.48)


@pytest.mark.parametrize('root', [None, Pose(), Pose((0.0, 0.0, -1.0))])
def test_there_is_none_without_a_robot_above_the_ground(
    stage: Stage, shadow: ContactShadow, root: Pose | None
) -> None:
    """It goes with the robot, and comes back with it."""
    shadow.place(Pose((0.0, 0.0, 0.8)))
    shadow.place(root)
    assert stage.node_at(PATH) is None
    shadow.place(Pose((0.0, 0.0, 0.8)))
    assert stage.node_at(PATH) is not None
