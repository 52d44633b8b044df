# SPDX-License-Identifier: Apache-2.0
"""Send a robot without physics through the apartment, a hundred times, and count how it arrives.

`tools/in_environment python3 tools/benchmarks/navigation_goals.py --goals 20`. The humanoid's Nav2
runs beside the loopback simulator, which moves as it is told and sees the map. Starts and goals
are drawn from the places of the map that can be reached; starts are told by /initialpose. The
status is 1 if more than 3 % fail, or if one does without saying why. Choose a speed at which the
computer does not lag behind: 2 takes most of a core, with everything.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
import os
from pathlib import Path
from statistics import mean, median
import sys
import time

from arguments import in_range
import cv2
from humanoid_common.testing.ros import ros_sandbox
from humanoid_navigation.arrival import Arrival, Place
from humanoid_navigation.loopback_testing import (
    container_pid,
    loopback_simulator,
    LoopbackRobot,
    running_navigation,
)
import numpy as np
import yaml

PACKAGE = Path(__file__).parents[2] / 'src' / 'humanoid_navigation'
PARAMETERS = PACKAGE / 'config' / 'nav2_params.yaml'
FAILURES_ALLOWED = 0.03
NEAR_M, NEAR_RAD = 0.3, 0.4
"""The tolerance of the goal checker, plus the permitted localisation error."""
WAY_M, PLACE_M = 0.35, 0.40
"""The minimum distance of a path and of its ends from walls."""


@dataclass(frozen=True)
class Trial:
    """A navigation trial, and its result."""

    number: int
    start: Place
    goal: Place
    outcome: Arrival

    @property
    def is_reached(self) -> bool:
        """Whether the robot reports that it has arrived, and has."""
        outcome = self.outcome
        near = outcome.distance_m <= NEAR_M and outcome.turn_rad <= NEAR_RAD
        return outcome.is_reached and near


def main() -> int:
    """Run, print a table, and return the exit status: 1 if too few goals were reached."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--goals', type=in_range(int, 1), default=100)
    parser.add_argument('--seed', type=in_range(int, 0), default=1)
    parser.add_argument('--skip', type=in_range(int, 0), default=0, help='pairs to leave out')
    parser.add_argument('--speed', type=in_range(float, 0.1), default=2.0)
    parser.add_argument('--log', type=Path, help='where to write what Nav2 says')
    options = parser.parse_args()
    pairs = drawn_pairs(PACKAGE / 'maps' / 'apartment.yaml', options.seed)
    for _ in range(options.skip):
        next(pairs)
    trials = list[Trial]()
    with (
        ros_sandbox() as ros,
        loopback_simulator(options.speed),
        running_navigation(f'params_file:={PARAMETERS}') as navigation,
    ):
        robot = LoopbackRobot(ros)
        robot.wait_for_active()
        pid = container_pid(navigation)
        begin_s, begin_cpu_s, begin_sim_s = time.monotonic(), cpu_s(pid), robot.now_s
        print('| goal | from | to | took | recoveries | result |\n|---|---|---|---|---|---|')
        try:
            for number in range(options.skip, options.skip + options.goals):
                trials.append(run_trial(robot, number, *next(pairs)))
                print(row(trials[-1]), flush=True)
        finally:
            if options.log:
                options.log.write_text(navigation.output, encoding='utf-8')
        wall_s, simulated_s = time.monotonic() - begin_s, robot.now_s - begin_sim_s
        print(summary(trials))
        share = (cpu_s(pid) - begin_cpu_s) / simulated_s
        print(
            f'{simulated_s:.0f} s in {wall_s:.0f} s; the container took {share:.1%} of a core '
            'for a simulated second'
        )
    failed = [trial for trial in trials if not trial.is_reached]
    silent = [t for t in failed if not t.outcome.is_reached and not t.outcome.error_msg]
    return int(bool(silent) or len(failed) > FAILURES_ALLOWED * len(trials))


def run_trial(robot: LoopbackRobot, number: int, start: Place, goal: Place) -> Trial:
    """
    Place the robot at a pose and navigate to another one.

    Parameters
    ----------
    robot
        The robot of the loopback simulator.
    number
        The number of the trial.
    start, goal
        The two poses in the map.

    Raises
    ------
    AssertionError
        The localisation does not accept the start, or the goal is rejected or takes too long.

    """
    robot.put(start)
    return Trial(number, start, goal, robot.go(goal))


def drawn_pairs(map_file: Path, seed: int) -> Iterator[tuple[Place, Place]]:
    """
    Draw an endless sequence of pairs of poses that are connected by a path.

    Parameters
    ----------
    map_file
        The YAML file of the map.
    seed
        The seed of the random numbers.

    Yields
    ------
    Place, Place
        Start and goal in the map, both at least `PLACE_M` from non-free cells.

    """
    table = yaml.safe_load(map_file.read_text(encoding='utf-8'))
    picture = cv2.imread(str(map_file.parent / table['image']), cv2.IMREAD_GRAYSCALE)
    assert picture is not None
    resolution_m = table['resolution']
    free = (picture[::-1] > 250).astype(np.uint8)
    clearance_m = cv2.distanceTransform(free, cv2.DIST_L2, cv2.DIST_MASK_PRECISE) * resolution_m
    _, labels = cv2.connectedComponents((clearance_m >= WAY_M).astype(np.uint8))
    largest = np.bincount(labels[labels > 0]).argmax()
    cells = np.argwhere((labels == largest) & (clearance_m >= PLACE_M))
    random = np.random.default_rng(seed)

    def place() -> Place:
        row_index, column = cells[random.integers(len(cells))]
        return (
            float(table['origin'][0] + (column + 0.5) * resolution_m),
            float(table['origin'][1] + (row_index + 0.5) * resolution_m),
            float(random.uniform(-np.pi, np.pi)),
        )

    while True:
        yield place(), place()


def row(trial: Trial) -> str:
    """
    Format the table row of a trial.

    Parameters
    ----------
    trial
        The finished trial.

    """
    outcome = trial.outcome
    result = f'{outcome.distance_m:.2f} m, {outcome.turn_rad:.2f} rad off'
    if not outcome.is_reached:
        result = f'status {outcome.status}, {outcome.error_code}: {outcome.error_msg or "EMPTY"}'
    elif not trial.is_reached:
        result = f'NOT THERE: {result}'
    start, goal = ('({:.2f}, {:.2f}, {:.2f})'.format(*each) for each in (trial.start, trial.goal))
    return (
        f'| {trial.number} | {start} | {goal} | {outcome.took_s:.1f} s | {outcome.recoveries} '
        f'| {result} |'
    )


def summary(trials: Sequence[Trial]) -> str:
    """
    Summarize the number of goals reached, and their arrival.

    Parameters
    ----------
    trials
        All trials.

    """
    reached = [trial.outcome for trial in trials if trial.is_reached]
    if not reached:
        return f'\n0 of {len(trials)} reached'
    return (
        f'\n{len(reached)} of {len(trials)} reached; '
        f'{median(o.took_s for o in reached):.1f} s in the median, '
        f'{max(o.took_s for o in reached):.1f} s at most; '
        f'{mean(o.distance_m for o in reached):.2f} m off in the mean, '
        f'{max(o.distance_m for o in reached):.2f} m at most; '
        f'{sum(t.outcome.recoveries for t in trials)} recoveries'
    )


def cpu_s(pid: int) -> float:
    """
    Read the CPU time in s that a process has used so far, excluding its children.

    Parameters
    ----------
    pid
        The process id.

    """
    fields = Path(f'/proc/{pid}/stat').read_text().rpartition(')')[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf('SC_CLK_TCK')


if __name__ == '__main__':
    sys.exit(main())
