# SPDX-License-Identifier: Apache-2.0
"""
Measure how fast a bottle drifts in the hand of a walking humanoid, by the contacts of its pads.

`tools/in_environment python3 tools/benchmarks/hand_drift.py`. The hand takes half a kilogram, and
the robot walks ahead, sideways and round corners. A row is printed for the usual contacts, and
one for each damping of contacts as stiff as those of the model, whose row is marked. It says how
far fingers rebound from the bottle when they close, and how fast the bottle then moves in the
gripper. There is no ROS: controllers and physics run in lockstep, with realistic noise.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from itertools import cycle

from arguments import in_range
from humanoid_simulation.errors import SimulationError
from humanoid_simulation.scene.scene import Thing
from humanoid_simulation.testing.lockstep_hand import LockstepHand
import numpy as np

RADIUS_M, HEIGHT_M = 0.0375, 0.262
BOTTLE = Thing('bottle', 'cylinder', (RADIUS_M, HEIGHT_M), (0.0, 3.0, HEIGHT_M / 2), mass_kg=0.5)
"""The bottle that `carry_trials.py` lets the robot carry."""
VELOCITIES = (
    *((0.3, 0.0, 0.0), (0.2, 0.0, 0.4), (0.0, 0.1, 0.0)),
    *((0.3, 0.0, -0.4), (0.3, 0.0, 0.0), (0.0, -0.1, 0.0)),
)
EACH_S, SETTLE_S = 4.0, 0.5
LOST_M = 0.1
"""A bottle that is farther from the middle of the fingers is lost."""
USUAL = 'usual'
DEFAULT_SOLREF = 0.02, 1.0
"""MuJoCo's time constant (s) and damping ratio of contacts."""


@dataclass(frozen=True)
class Drift:
    """How fast a bottle moved in the gripper while the robot walked, and how fingers closed."""

    rebound_mm: float
    out_mm_s: float
    """Velocity towards the fingertips."""
    across_mm_s: float
    """Speed across the hand: down or up in a level one, and aside."""
    lost_s: float | None
    """How long the robot had walked when the bottle was lost, if it was."""


def main() -> None:
    """Measure for each damping, and print the table."""
    parser = argparse.ArgumentParser(description=__doc__.strip().split('\n')[0])
    parser.add_argument(
        '--dampings',
        type=in_range(float, 0.1, 2.5),
        nargs='+',
        default=[1.0, 1.3, 2.0],
        help='dampings of the contacts, in units of one per physics period',
    )
    parser.add_argument(
        '--seconds', type=in_range(float, EACH_S), default=60.0, help='how long it walks'
    )
    parser.add_argument(
        '--force',
        type=in_range(float, 0.0),
        default=25.0,
        help='of the fingers, in N: by default that of pick; 0 is the full force',
    )
    options = parser.parse_args()
    print('| damping | rebound | to the fingertips | across the hand | |\n|---|---|---|---|---|')
    for damping in (None, *options.dampings):
        hand = LockstepHand(BOTTLE)
        name = use(hand, damping)
        drift = measured(hand, options.force, options.seconds)
        end = 'kept' if drift.lost_s is None else f'lost after {drift.lost_s:.0f} s'
        print(
            f'| {name} | {drift.rebound_mm:.2f} mm | {drift.out_mm_s:.3f} mm/s '
            f'| {drift.across_mm_s:.3f} mm/s | {end} |',
            flush=True,
        )
        hand.robot.backend.close()


def use(hand: LockstepHand, damping: float | None) -> str:
    """
    Change the contacts of the pads of both hands; return the name of the row.

    Parameters
    ----------
    hand
        The hand of the robot.
    damping
        In units of one per physics period; None is for contacts that are mixed from MuJoCo's
        default and those of the object.

    """
    model = hand.robot.backend.model
    pads = [
        number
        for number in range(model.ngeom)
        if model.geom_contype[number]
        and model.body(model.geom_bodyid[number]).name.endswith(('_finger', '_thumb'))
    ]
    if damping is None:
        model.geom_priority[pads] = 1
        model.geom_solref[pads] = DEFAULT_SOLREF
        return USUAL
    wanted = -damping / model.opt.timestep
    is_own = bool(np.allclose(model.geom_solref[pads, 1], wanted))
    model.geom_solref[pads, 1] = wanted
    return f'{damping:g}{" (the model)" if is_own else ""}'


def measured(hand: LockstepHand, most_n: float, duration_s: float) -> Drift:
    """
    Take the bottle, walk, and measure its drift.

    Parameters
    ----------
    hand
        A hand that is open.
    most_n
        The maximum force of the fingers; 0 is that of the actuator.
    duration_s
        How long the robot walks, in simulated time.

    Raises
    ------
    AssertionError
        The robot falls.

    """
    gaps_m: list[float] = []
    hand.take_bottle(most_n, lambda: gaps_m.append(hand.true_gap_m))
    rebound_m = float(np.max(gaps_m - np.minimum.accumulate(gaps_m)))
    assert hand.robot.wait(SETTLE_S), 'the robot has fallen'
    first_m, backend = hand.bottle_m, hand.robot.backend
    begin_s, lost_s = backend.time_s, None
    try:
        for velocity in cycle(VELOCITIES):
            hand.robot.drive(*velocity)
            assert hand.robot.wait(EACH_S), 'the robot has fallen'
            walked_s = backend.time_s - begin_s
            if np.linalg.norm(hand.bottle_m) > LOST_M:
                lost_s = walked_s
            if lost_s or walked_s > duration_s - 0.5 * EACH_S:
                break
    except SimulationError:
        lost_s = backend.time_s - begin_s
    x, y, z = (1e3 * (hand.bottle_m - first_m) / (backend.time_s - begin_s)).tolist()
    return Drift(1e3 * rebound_m, -z, float(np.hypot(x, y)), lost_s)


if __name__ == '__main__':
    main()
