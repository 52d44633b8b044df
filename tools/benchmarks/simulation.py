# SPDX-License-Identifier: Apache-2.0
"""Measure what the simulated humanoid costs: control and physics, and the whole with ROS.

`make bench ARGS='--runs 5'`. The first table is of lockstep without ROS; the times are CPU time of
one thread. The second one starts the simulator, drives it by `cmd_vel`, and reads its CPU time.
The third one is of the laser scanner: sweeps by themselves, and what the simulator takes with them
and without.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from statistics import median
import time
from typing import TypeVar

from humanoid_control.walking import VelocityCommand
from humanoid_simulation.backend import BackendSettings, MujocoBackend
from humanoid_simulation.laser_scanner import LaserScanner, ScanNoise
from humanoid_simulation.scene import load_scene
from humanoid_simulation.testing.lockstep_robot import LockstepRobot
import mujoco
from simulator_run import Share, simulator_share

T = TypeVar('T')
FORWARD_M_S = 0.25
SETTLE_TICKS = 200
TICKS = 1000
SWEEPS = 200
SCENES = ('flat', 'room', 'apartment')
FACTORS = {1.0: 'in real time', 0.0: 'as fast as possible'}


def main() -> None:
    """Measure and print the tables."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--runs', type=int, default=3, help='runs of each row')
    runs = parser.parse_args().runs
    print_costs([TickCosts().means_us() for _ in range(runs)])
    print(f'\n{"CPU %":>7} {"faster":>7}  the simulator while it walks, median of {runs} runs')
    for factor, what in FACTORS.items():
        print_share([simulator_share(factor, FORWARD_M_S) for _ in range(runs)], what)
    print(f'\n{"CPU us":>7}  of a sweep of the laser scanner, least of {SWEEPS}')
    for scene in SCENES:
        print(f'{sweep_us(scene):7.0f}  {scene}', flush=True)
    print(f'\n{"CPU %":>7} {"faster":>7}  the simulator in the scene {SCENES[-1]}, in real time')
    for scans, what in ((False, 'without the laser scanner'), (True, 'with it, at 10 Hz')):
        print_share(
            [simulator_share(1.0, FORWARD_M_S, SCENES[-1], scans) for _ in range(runs)], what
        )


def print_costs(runs: list[dict[str, float]]) -> None:
    """
    Print the cost of the parts of a tick while the robot walks.

    Parameters
    ----------
    runs
        For each run, the CPU time of each part in us.

    """
    settings = BackendSettings()
    print(f'{"CPU us":>7}  of a tick, mean of {TICKS} while it walks, median of {len(runs)} runs')
    for name in runs[0]:
        print(f'{median(run[name] for run in runs):7.0f}  {name}')
    whole_us = median(sum(run.values()) for run in runs)
    print(f'{whole_us:7.0f}  together, {settings.period_s * 1e6 / whole_us:.1f} times real time')
    step_us = median(run['step'] for run in runs) / settings.steps_per_period
    print(f'{1e6 / step_us:7.0f}  physics steps a second', flush=True)


def print_share(runs: list[Share], what: str) -> None:
    """
    Print the share of a core that the simulator uses, and its real-time factor.

    Parameters
    ----------
    runs
        The measurements; the row has the medians.
    what
        The name of the row.

    """
    cpu, factor = median(run.cpu for run in runs), median(run.factor for run in runs)
    print(f'{cpu:7.1%} {factor:7.2f}  {what}', flush=True)


def sweep_us(scene: str) -> float:
    """
    Measure the minimum CPU time of a laser scan, with noise, of a standing robot.

    Parameters
    ----------
    scene
        The name of the scene around it.

    Returns
    -------
    float
        Microseconds, with the forward kinematics that a sweep needs.

    """
    backend = MujocoBackend(scene=load_scene(scene))
    model, data = backend.model, mujoco.MjData(backend.model)
    scanner = LaserScanner(model, 'robot/laser', noise=ScanNoise(0.01, 0.002))
    spent_s = []
    for time_ns in range(SWEEPS):
        begin_s = time.process_time()
        data.qpos[:] = backend.data.qpos
        mujoco.mj_kinematics(model, data)
        scanner.sweep(data, time_ns)
        spent_s.append(time.process_time() - begin_s)
    return min(spent_s) * 1e6


class TickCosts:
    """A robot that walks without ROS, and the CPU time of the parts of its ticks."""

    def __init__(self) -> None:
        """Settle the robot while it stands, and start walking."""
        robot = LockstepRobot()
        self._backend, self._control = robot.backend, robot.walking.control
        self._spent_s: dict[str, float] = {}
        self._go(SETTLE_TICKS, 0.0)
        self._go(SETTLE_TICKS, FORWARD_M_S)

    def means_us(self) -> dict[str, float]:
        """Walk, and return the mean CPU time of each part."""
        self._spent_s = {}
        self._go(TICKS, FORWARD_M_S)
        return {name: spent_s / TICKS * 1e6 for name, spent_s in self._spent_s.items()}

    def _go(self, ticks: int, forward_m_s: float) -> None:
        """Run a number of ticks: observe, control and step."""
        backend, control = self._backend, self._control
        for _ in range(ticks):
            control.walk(VelocityCommand(forward_m_s))
            observation = self._timed('observe', lambda: backend.observe()[''])
            targets = self._timed('control', lambda: control.update(observation))  # noqa: B023
            self._timed('step', lambda: backend.step({'': targets}))  # noqa: B023

    def _timed(self, name: str, action: Callable[[], T]) -> T:
        """Run an action and add its CPU time to a part."""
        begin_s = time.process_time()
        result = action()
        self._spent_s[name] = self._spent_s.get(name, 0.0) + time.process_time() - begin_s
        return result


if __name__ == '__main__':
    main()
