# SPDX-License-Identifier: Apache-2.0
"""Base class of the behaviours: a control cycle with a time limit, after which the robot stops."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
import math
from typing import Any, ClassVar

from builtin_interfaces.msg import Duration
from nav2_behaviors.behavior_node import BehaviorNode
from nav2_behaviors.collision_checker import CannotCheck
from nav2_util import ActionAborted, ActionServer, parameter, Pose2D, Rate, TransformError
from nav2_util.timing import now_s
from nav2_util.twist import Velocity
import numpy as np
import numpy.typing as npt

__all__ = ['LookAheadParameters', 'TimedBehavior', 'duration_message', 'seconds']

_CHECKS_HZ = 20.0
_STALE_POSE_S = 1.0


@dataclass(frozen=True)
class LookAheadParameters:
    """Parameters of behaviours that predict collisions, without a prefix."""

    simulate_ahead_time: float = parameter(
        2.0, 'How far to look ahead for collisions (s).', low=0.0
    )


class TimedBehavior(ABC):
    """
    Base class of behaviours: an action whose goals are executed in control cycles.

    Subclasses define their `action`, prepare a goal in `begin` and execute it in `step`. Both may
    raise ActionAborted. However a goal ends, the robot is stopped.

    Parameters
    ----------
    node
        The behaviour server.
    name
        The name of the behaviour, and of its action.

    """

    action: ClassVar[Any]

    def __init__(self, node: BehaviorNode, name: str) -> None:
        self.node, self.name = node, name
        self.configure()
        self.server: ActionServer = node.offer_action(self.action, name, self._work)

    def configure(self) -> None:  # noqa: B027
        """Declare the parameters of the behaviour, and create its subscriptions."""

    @abstractmethod
    def begin(self, goal: Any) -> None:
        """
        Check a goal, and prepare for it.

        Parameters
        ----------
        goal
            The goal message of the action.

        Raises
        ------
        ActionAborted
            The goal cannot be reached.

        """

    @abstractmethod
    def step(self, elapsed_s: float) -> bool:
        """
        Execute one cycle of the goal; called at `cycle_frequency`.

        Parameters
        ----------
        elapsed_s
            The time since the start of the goal, in s of the node's clock.

        Returns
        -------
        bool
            Whether the goal is reached.

        Raises
        ------
        ActionAborted
            The goal cannot be reached any more.

        """

    def time_allowance_s(self, goal: Any) -> float:
        """
        Return the time allowance of a goal in s; 0 for no limit.

        Parameters
        ----------
        goal
            The goal message of the action.

        """
        return seconds(goal.time_allowance)

    def abort(self, code: str, message: str) -> ActionAborted:
        """
        Make the error that aborts the goal.

        Parameters
        ----------
        code
            The name of an error code in the action's result, such as `TIMEOUT`; a name that the
            result does not have stands for 1.
        message
            The error message, a full sentence.

        """
        return ActionAborted(int(getattr(self.action.Result, code, 1)), message)

    def pose(self) -> Pose2D:
        """Look up the pose of the robot in the local frame; raise ActionAborted if unavailable."""
        told = self.node.told.current
        try:
            return self.node.transforms.pose_of(
                told.robot_base_frame,
                told.local_frame,
                not_older_s=_STALE_POSE_S + told.transform_tolerance,
            )
        except TransformError as error:
            raise self.abort('TF_ERROR', str(error)) from error

    def check_ahead(self, poses: npt.NDArray[np.float64]) -> None:
        """
        Check that the robot can pass poses without a collision.

        Parameters
        ----------
        poses
            Poses (K, 3): x, y (m) and yaw (rad) in the current base frame, in order.

        Raises
        ------
        ActionAborted
            The footprint would be on an obstacle or off the local costmap, or the check is
            impossible.

        """
        try:
            hit = self.node.local_checker.first_collision(poses)
        except CannotCheck as error:
            raise self.abort(
                'COLLISION_AHEAD', f"'{self.name}' cannot check whether its path is free. {error}"
            ) from error
        if hit is not None:
            distance = math.hypot(poses[hit, 0], poses[hit, 1])
            turn = abs(poses[hit, 2])
            raise self.abort(
                'COLLISION_AHEAD',
                f"'{self.name}' stopped before a collision: after {distance:.2f} m and "
                f'{turn:.2f} rad the footprint would be on an obstacle, or off the costmap.',
            )

    def drive(self, velocity: Velocity) -> None:
        """
        Publish a velocity command.

        Parameters
        ----------
        velocity
            The velocity in the base frame.

        """
        self.node.velocities.publish(velocity)

    async def _work(self, goal: Any) -> None:
        started_s = now_s(self.node)
        try:
            await self._cycle(goal, started_s)
        finally:
            elapsed_s = max(now_s(self.node) - started_s, 0.0)
            self.server.result.total_elapsed_time = duration_message(elapsed_s)
            if self.node.is_active:
                self.drive(Velocity())

    async def _cycle(self, goal: Any, started_s: float) -> None:
        allowance_s = self.time_allowance_s(goal)
        cycle_hz = self.node.told.current.cycle_frequency
        # Cancel requests are checked more often than commands are published.
        checks = max(math.ceil(_CHECKS_HZ / cycle_hz), 1)
        self.server.check()
        self.begin(goal)
        with Rate(self.node, cycle_hz * checks) as rate:
            while True:
                # Simulated time restarts when the simulation is reset.
                started_s = min(started_s, now_s(self.node))
                elapsed_s = now_s(self.node) - started_s
                if 0.0 < allowance_s < elapsed_s:
                    raise self.abort(
                        'TIMEOUT',
                        f"'{self.name}' has not ended within its time allowance of "
                        f'{allowance_s:g} s.',
                    )
                if self.step(elapsed_s):
                    return
                for _ in range(checks):
                    await rate.tick()
                    self.server.check()


def seconds(duration: Duration) -> float:
    """
    Convert a duration message to seconds.

    Parameters
    ----------
    duration
        The message; may be negative.

    """
    return float(duration.sec) + float(duration.nanosec) * 1e-9


def duration_message(duration_s: float) -> Duration:
    """
    Convert seconds to a duration message.

    Parameters
    ----------
    duration_s
        The duration in s; may be negative.

    """
    whole = math.floor(duration_s)
    return Duration(sec=int(whole), nanosec=int((duration_s - whole) * 1e9))
