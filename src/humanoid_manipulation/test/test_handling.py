# SPDX-License-Identifier: Apache-2.0
"""Check how things are carried."""

from __future__ import annotations

from humanoid_description.drives import SIDES
from humanoid_description.expansion import humanoid_urdf
from humanoid_description.loading import load_robot
from humanoid_manipulation.grasps import Graspable, grasps_of
from humanoid_manipulation.held_things import carrying
from humanoid_manipulation.picking import held_by
from humanoid_manipulation.surroundings import Remembered
from humanoid_manipulation.upper_body import UpperBody
import numpy as np
import pytest

BODY = UpperBody.of(load_robot(humanoid_urdf(hands=True), 'humanoid'))
SIZES_M = {
    'bottle': (0.066, 0.066, 0.22),
    'mug': (0.08, 0.08, 0.10),
    'apple': (0.07, 0.07, 0.07),
}


@pytest.mark.parametrize('side', SIDES)
@pytest.mark.parametrize('kind', SIZES_M)
def test_what_is_carried_stays_upright_close_and_clear(kind: str, side: str) -> None:
    """However it was taken."""
    at = np.array([2.0, 1.0, 0.8 + SIZES_M[kind][2] / 2.0])
    thing = Remembered(f'{kind}_1', (kind,), Graspable(kind, at, np.array(SIZES_M[kind])))
    grasps = list(grasps_of(thing.graspable))
    assert grasps
    for grasp in grasps:
        held = held_by(thing, grasp, grasp.width_m)
        gripper = BODY.forward(side, carrying(BODY, side, held))
        box = gripper.rotation @ held.box.middle.rotation
        assert box[:, 2] == pytest.approx([0.0, 0.0, 1.0], abs=1e-6)
        middle = gripper.position_m + gripper.rotation @ held.box.middle.position_m
        assert 0.15 < middle[0] < 0.50
        assert middle[1] * (1.0 if side == 'left' else -1.0) > 0.05
        assert middle[2] - SIZES_M[kind][2] / 2.0 > 0.0


def test_fingers_do_not_hold_what_hangs_far_below() -> None:
    """A bottle is taken from the side; what is short, from above too."""
    for kind, above in (('bottle', False), ('mug', True), ('apple', True)):
        at = np.array([0.0, 0.0, SIZES_M[kind][2] / 2.0])
        grasps = grasps_of(Graspable(kind, at, np.array(SIZES_M[kind])))
        assert any(each.from_above for each in grasps) is above
