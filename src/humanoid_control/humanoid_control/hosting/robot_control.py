# SPDX-License-Identifier: Apache-2.0
"""All that decides what one robot does: its mode, those who move its joints, and the stop."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers import (
    checked_goal,
    checked_trajectory,
    CommandError,
    ControllerManager,
    Follower,
    GoalController,
    Grip,
    Guest,
    JointNames,
    Mode,
    TrajectoryGoal,
    TrajectoryPoint,
    TrajectoryRequest,
    TrajectoryRunner,
)
from humanoid_control.controllers.limbs import gripper_controllers, limb_controllers
from humanoid_control.controllers.silence import Clock
from humanoid_control.controllers.still import Still
from humanoid_control.hosting.velocity_input import VelocityInput
from humanoid_control.limits import JointLimits
from humanoid_control.walking.body_pose import BodyPose
from humanoid_control.walking.velocity_command import STANDING, VelocityCommand

Drive = Callable[[VelocityCommand], None]
HoldBody = Callable[[BodyPose | None], None]
HELD = 'The robot must hold still; stop_state says why.'


class RobotControl:
    """
    The controllers of a robot, as commands from outside and a stop reach them.

    Commands are stored, and obeyed in the next period. While the robot must hold still, it walks
    at velocity zero, every joint that its mode lends is held, and commands are not heard.
    """

    def __init__(
        self,
        joints: Sequence[str],
        limits: JointLimits,
        modes: Sequence[Mode],
        drive: Drive | None = None,
        clock: Clock | None = None,
        say: Callable[[str], None] = lambda sentence: None,
        hold_body: HoldBody | None = None,
    ) -> None:
        """
        Begin in the first mode.

        :param drive: what walks, if anything does
        :param hold_body: what bends the body, if anything does; None is as it is now
        """
        self._hold_body = hold_body
        self._names, self._limits, self._drive = JointNames(joints), limits, drive
        self.still = Still(joints)
        """Owns the joints while the robot must hold still."""
        self._runner = TrajectoryRunner(joints)
        self._follower = Follower(joints, clock=clock)
        self._velocity = VelocityInput(clock=clock)
        self.trajectory_controllers = {each.name: each for each in limb_controllers(joints)}
        """Those of arms and head, by their names."""
        self.gripper_controllers = {
            each.name: each for each in gripper_controllers(joints, limits)
        }
        self.controllers: Mapping[str, GoalController[Any, Any]] = {
            **self.trajectory_controllers,
            **self.gripper_controllers,
        }
        """All that take goals, by their names."""
        limbs = self.controllers.values()
        guests: list[Guest] = [self.still, *limbs, self._runner, self._follower]
        self.manager = ControllerManager(joints, modes, guests, limits, say)

    @property
    def must_hold(self) -> bool:
        """Tell whether the robot must hold still."""
        return self.still.on

    def follow(
        self,
        names: Sequence[str],
        positions_rad: Sequence[float],
        velocities_rad_s: Sequence[float] = (),
        efforts_nm: Sequence[float] = (),
    ) -> None:
        """Move some joints as commanded, or raise CommandError."""
        command = self._names.targets(names, positions_rad, velocities_rad_s, efforts_nm)
        if not self.must_hold:
            self.manager.check(self._follower, command.places)
            self._follower.accept(command)

    def run(self, names: Sequence[str], points: Sequence[TrajectoryPoint]) -> None:
        """Move some joints along a trajectory, or raise CommandError."""
        trajectory = checked_trajectory(self._names, self._limits, names, points)
        if not self.must_hold:
            self.manager.check(self._runner, trajectory.places)
            self._runner.accept(trajectory)

    def checked_goal(self, controller: str, request: TrajectoryRequest) -> TrajectoryGoal:
        """Return a goal that a controller can be given now, or raise CommandError."""
        wanted = self.trajectory_controllers[controller]
        goal = checked_goal(controller, wanted.own, self._names, self._limits, request)
        self._check_free(wanted)
        return goal

    def checked_grip(self, controller: str, gap_m: float, most_n: float) -> Grip:
        """Return a grip that the controller of a gripper can be given now, or CommandError."""
        wanted = self.gripper_controllers[controller]
        grip = wanted.checked(gap_m, most_n)
        self._check_free(wanted)
        return grip

    def _check_free(self, controller: GoalController[Any, Any]) -> None:
        """Refuse a goal of a controller that cannot have its joints now."""
        if not controller.is_active:
            raise CommandError(
                f"'{controller.name}' is inactive. Activate it: ros2 control switch_controllers "
                f'--activate {controller.name}'
            )
        if self.must_hold:
            raise CommandError(HELD)
        self.manager.check(controller, controller.places)

    def walk(self, velocity: VelocityCommand) -> None:
        """Walk at a velocity until the timeout, or raise CommandError."""
        if self._drive is None:
            raise CommandError('This robot does not walk: nothing in it takes a velocity.')
        if not self.must_hold:
            self._velocity.accept(velocity)

    def hold_body(self, pose: BodyPose) -> None:
        """Hold the body in a pose until the robot walks, or raise CommandError."""
        if self._hold_body is None:
            raise CommandError('This robot does not bend: nothing in it takes a pose of the body.')
        if not self.must_hold:
            self._hold_body(pose)

    def hold_still(self, must: bool) -> None:
        """Begin to hold still, or be released; what was commanded before is forgotten."""
        if must and not self.must_hold:
            self._forget()
            if self._hold_body is not None:
                self._hold_body(None)
            for controller in self.controllers.values():
                controller.abort(HELD)
        self.still.on = must

    def update(self, observation: Observation) -> JointTargets:
        """Return the targets of all joints for the coming period."""
        if self._drive is not None:
            velocity = self._velocity.at(observation.time_s)
            must_stand = self.must_hold or self.manager.is_leaving
            self._drive(STANDING if must_stand else velocity)
        targets = self.manager.update(observation)
        self._end_lost_goals()
        return targets

    def reset(self) -> None:
        """Begin anew with the next observation."""
        self._forget()
        self.manager.reset()

    def _end_lost_goals(self) -> None:
        """End the goals of controllers whose joints somebody else has taken."""
        trouble = self.manager.trouble
        for controller in self.controllers.values():
            if trouble:
                controller.release(f'{trouble[:1].upper()}{trouble[1:]}.')
            elif controller.has_goal and not self.manager.owns(controller, controller.places):
                owners = {self.manager.owner(joint) for joint in controller.own}
                others = ', '.join(f"'{name}'" for name in sorted(owners - {controller.name}))
                controller.abort(f'Its joints were taken by {others}.')

    def _forget(self) -> None:
        """Forget what was commanded."""
        self._velocity.clear()
        self._runner.cancel()
        self._follower.cancel()
