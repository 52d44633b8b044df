# SPDX-License-Identifier: Apache-2.0
"""Control of one robot: its mode, its controllers and the stop."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from humanoid_control.backends import JointLimits, JointTargets, Observation
from humanoid_control.controllers import (
    checked_trajectory,
    ClaimingController,
    CommandError,
    ControllerManager,
    Follower,
    JointNames,
    Mode,
    TrajectoryPoint,
    TrajectoryRunner,
)
from humanoid_control.controllers.command_controllers import Clock, Silence
from humanoid_control.controllers.goal_controllers import GoalControllers, HELD
from humanoid_control.controllers.gripper_controller import gripper_controllers
from humanoid_control.controllers.joint_trajectory_controller import limb_controllers
from humanoid_control.controllers.modes import Still
from humanoid_control.walking.commands import BodyPose, STANDING, VelocityCommand

WalkAt = Callable[[VelocityCommand], None]
HoldBody = Callable[[BodyPose | None], None]
VELOCITY_TIMEOUT_S = 0.5


class RobotControl:
    """
    Control of one robot: its modes and controllers, the commands for them, and a stop.

    Commands are stored, and obeyed in the next period. While the robot must hold still, it walks
    at velocity zero, every joint that its mode leaves to controllers is held, and commands are
    ignored.

    Parameters
    ----------
    joints
        All n joints of the robot, in the order of observations and targets.
    limits
        Range, velocity, effort and stiffness of the n joints.
    modes
        The modes, whose controllers claim all joints in that order; the first one is entered.
    walk
        Called in each period with the velocity at which to walk; None if the robot cannot walk.
    clock
        Returns the computer's time in s: commands expire when the timeout has passed by it and by
        the robot's time; without it only the robot's time counts.
    say
        Receives a message when a controller asks for targets that are not finite.
    hold_body
        Called with the body pose to hold, or with None to keep the current one; None if the robot
        cannot bend its body.

    Raises
    ------
    ValueError
        The controller of the first mode claims other joints, or in another order.

    """

    def __init__(
        self,
        joints: Sequence[str],
        limits: JointLimits,
        modes: Sequence[Mode],
        walk: WalkAt | None = None,
        clock: Clock | None = None,
        say: Callable[[str], None] = lambda sentence: None,
        hold_body: HoldBody | None = None,
    ) -> None:
        self._hold_body = hold_body
        self._names, self._limits, self._walk = JointNames(joints), limits, walk
        self.still = Still(joints)
        """Claims the joints while the robot must hold still."""
        self._runner = TrajectoryRunner(joints)
        self._follower = Follower(joints, clock=clock)
        self._velocity, self._silence = STANDING, Silence(VELOCITY_TIMEOUT_S, clock)
        limbs, grippers = limb_controllers(joints), gripper_controllers(joints, limits)
        claimants: list[ClaimingController] = [self.still, *limbs, *grippers]
        claimants += [self._runner, self._follower]
        self.manager = ControllerManager(joints, modes, claimants, limits, say)
        claims = self.manager.claims
        self.goals = GoalControllers(self._names, limits, limbs, grippers, self.still, claims)
        """The controllers that accept goals."""

    @property
    def must_hold(self) -> bool:
        """Whether the robot must hold still."""
        return self.still.on

    def follow(
        self,
        names: Sequence[str],
        positions_rad: Sequence[float],
        velocities_rad_s: Sequence[float] = (),
        efforts_nm: Sequence[float] = (),
    ) -> None:
        """
        Command joints to positions, from the next control period on.

        While the robot must hold still, a valid command is dropped.

        Parameters
        ----------
        names
            Names of the m joints, each once.
        positions_rad
            Target positions (m,); in m if prismatic.
        velocities_rad_s, efforts_nm
            Target velocities and additional efforts (m,), or empty for zero; in m/s and N if
            prismatic.

        Raises
        ------
        CommandError
            The command is invalid, or the joints belong to the mode or to a controller of higher
            priority.

        """
        command = self._names.targets(names, positions_rad, velocities_rad_s, efforts_nm)
        if not self.must_hold:
            self.manager.claims.check(self._follower, command.indices)
            self._follower.accept(command)

    def run(self, names: Sequence[str], points: Sequence[TrajectoryPoint]) -> None:
        """
        Move joints along a trajectory that starts with the next control period.

        While the robot must hold still, a valid trajectory is dropped.

        Parameters
        ----------
        names
            Names of the m joints, each once.
        points
            Trajectory points; each has m values, in the order of the names.

        Raises
        ------
        CommandError
            The joints cannot follow it, or belong to the mode or to a controller of higher
            priority.

        """
        trajectory = checked_trajectory(self._names, self._limits, names, points)
        if not self.must_hold:
            self.manager.claims.check(self._runner, trajectory.indices)
            self._runner.accept(trajectory)

    def walk(self, velocity: VelocityCommand) -> None:
        """
        Command a walking velocity, which expires unless it is repeated within the timeout.

        While the robot must hold still, the command is dropped.

        Parameters
        ----------
        velocity
            The velocity in the axes of the body.

        Raises
        ------
        CommandError
            The robot cannot walk.

        """
        if self._walk is None:
            raise CommandError('This robot cannot walk: it accepts no velocity commands.')
        if not self.must_hold:
            self._velocity = velocity
            self._silence.heard()

    def hold_body(self, pose: BodyPose) -> None:
        """
        Command the height and pitch of the body, which it keeps until the robot walks.

        While the robot must hold still, the command is dropped.

        Parameters
        ----------
        pose
            Pose of the pelvis; the gait limits it to what is feasible.

        Raises
        ------
        CommandError
            The robot cannot bend its body.
        WalkingError
            The pose is not finite.

        """
        if self._hold_body is None:
            raise CommandError('This robot cannot bend: it accepts no body pose commands.')
        if not self.must_hold:
            self._hold_body(pose)

    def hold_still(self, must: bool) -> None:
        """
        Stop the robot, or release it.

        A stop drops all commands, aborts the goals, and keeps the current body pose.

        Parameters
        ----------
        must
            Whether the robot must hold still; the same value again changes nothing.

        """
        if must and not self.must_hold:
            self._forget()
            if self._hold_body is not None:
                self._hold_body(None)
            self.goals.abort(HELD)
        self.still.on = must

    def update(self, observation: Observation) -> JointTargets:
        """
        Compute the joint targets for the coming control period. Call once per period.

        The velocity is zero once its command has expired, and while the robot must hold still or
        is leaving its mode.

        Parameters
        ----------
        observation
            Sensor values of the robot at the start of the period.

        Returns
        -------
        JointTargets
            Targets of all n joints, each array (n,), within their limits.

        """
        if self._walk is not None:
            has_expired = self._silence.lasts(observation.time_s)
            must_stand = has_expired or self.must_hold or self.manager.is_leaving
            self._walk(STANDING if must_stand else self._velocity)
        targets = self.manager.update(observation)
        self.goals.end_lost()
        return targets

    def reset(self) -> None:
        """Drop all commands, and restart from the next observation."""
        self._forget()
        self.manager.reset()

    def _forget(self) -> None:
        """Drop all commands."""
        self._silence.end()
        self._runner.cancel()
        self._follower.cancel()
