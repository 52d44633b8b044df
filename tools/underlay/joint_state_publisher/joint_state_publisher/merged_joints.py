# SPDX-License-Identifier: Apache-2.0
"""Joint states of a robot, merged from several sources, and those of independent joints."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from math import isfinite, pi

from joint_state_publisher.settings import Settings
from ros_environment.suggestions import did_you_mean
from urdf import check_for_loops, followed, Joint, Mimic, RobotModel

__all__ = ['FreeJoint', 'MergedJoints', 'States']

QUANTITIES = ('position', 'velocity', 'effort')


@dataclass
class States:
    """Joint states by name; each quantity has a value for every name, or is empty."""

    name: list[str] = field(default_factory=list)
    position: list[float] = field(default_factory=list)
    velocity: list[float] = field(default_factory=list)
    effort: list[float] = field(default_factory=list)


class MergedJoints:
    """
    Merges joint states of several sources and computes the states of all joints.

    Parameters
    ----------
    model
        The robot.
    settings
        The parameters: default positions, limits and dependent joints.

    Attributes
    ----------
    free
        The independent joints, which mimic no other joint, by name.

    Raises
    ------
    ValueError
        `dependent_joints` names a parent that is not a movable joint, or contains a loop.

    """

    def __init__(self, model: RobotModel, settings: Settings) -> None:
        mimics = _mimics(model, settings)
        moving = model.moving_joints
        self.free = {
            joint.name: FreeJoint.of(joint, settings.use_smallest_joint_limits)
            for joint in moving
            if joint.name not in mimics
        }
        self._leaders = {
            joint.name: leader
            for joint in moving
            if (leader := followed(joint.name, mimics, self.free)) is not None
        }
        self.defaults = {
            name: settings.zeros.get(name, joint.zero) for name, joint in self.free.items()
        }
        """The default positions."""
        self._set_defaults(settings)

    def _set_defaults(self, settings: Settings) -> None:
        for name, joint in self.free.items():
            if settings.publish_default_positions:
                joint.position = self.defaults[name]
            if settings.publish_default_velocities:
                joint.velocity = 0.0
            if settings.publish_default_efforts:
                joint.effort = 0.0

    def take(self, states: States) -> None:
        """
        Update the independent joints with the joint states of a source.

        Missing and non-finite values leave the state unchanged.

        Parameters
        ----------
        states
            Names and their positions (rad, m), velocities and efforts (N m, N); unknown names are
            ignored.

        Raises
        ------
        ValueError
            A quantity has values, but their number differs from that of the names; nothing is
            updated.

        """
        for quantity in QUANTITIES:
            values = getattr(states, quantity)
            if len(values) not in (0, len(states.name)):
                raise ValueError(f'{len(states.name)} names but {len(values)} {quantity} values')
        for quantity in QUANTITIES:
            for name, value in zip(states.name, getattr(states, quantity)):
                if name in self.free and isfinite(value):
                    setattr(self.free[name], quantity, value)

    def not_finite(self, states: States) -> list[str]:
        """
        List the independent joints whose position in a message is not finite.

        Parameters
        ----------
        states
            The joint states of a source.

        """
        return [
            name
            for name, position in zip(states.name, states.position)
            if name in self.free and not isfinite(position)
        ]

    def move(self, delta: float) -> None:
        """
        Advance every independent joint by a step, back and forth between its limits.

        Parameters
        ----------
        delta
            The step, in rad or m.

        """
        for joint in self.free.values():
            joint.move(delta)

    def states(self) -> States:
        """
        Return the known joint states, in the order of the URDF.

        A quantity that is known for some of the joints only is 0 for the others.
        """
        known = {
            name: leader
            for name, leader in self._leaders.items()
            if any(
                getattr(self.free[leader.joint], quantity) is not None for quantity in QUANTITIES
            )
        }
        return States(
            list(known),
            *(self._values(list(known.values()), quantity) for quantity in QUANTITIES),
        )

    def _values(self, leaders: Sequence[Mimic], quantity: str) -> list[float]:
        """Return the values of a quantity; empty if it is unknown for every joint."""
        values = [getattr(self.free[leader.joint], quantity) for leader in leaders]
        if all(value is None for value in values):
            return []
        # The offset applies to positions only. There is no established rule for efforts; they are
        # scaled like velocities.
        with_offset = quantity == 'position'
        return [
            leader.multiplier * (value or 0.0) + (leader.offset if with_offset else 0.0)
            for leader, value in zip(leaders, values)
        ]

    def surplus_zeros(self, settings: Settings) -> Iterator[str]:
        """
        Warn of parameters `zeros.JOINT` that apply to no joint.

        Parameters
        ----------
        settings
            The parameters.

        Yields
        ------
        str
            A warning for each of them.

        """
        for name in settings.zeros:
            if name not in self.free:
                why = 'follows another joint' if name in self._leaders else 'is not a moving joint'
                yield (
                    f"The parameter 'zeros.{name}' is not used: '{name}' {why} of this robot. "
                    f'{did_you_mean(name, self.free, 0.75)}'.rstrip()
                )


def _mimics(model: RobotModel, settings: Settings) -> dict[str, Mimic]:
    """Return the mimic joints; `dependent_joints` takes precedence over the URDF."""
    moving = {joint.name for joint in model.moving_joints}
    dependents = {
        name: mimic for name, mimic in settings.dependent_joints.items() if name in moving
    }
    for name, mimic in dependents.items():
        if mimic.joint not in moving:
            raise ValueError(
                f"'dependent_joints' lets '{name}' follow '{mimic.joint}', which is not a moving "
                f'joint of this robot. {did_you_mean(mimic.joint, moving, 0.75)}'.rstrip()
            )
    mimics = {**(model.mimics if settings.use_mimic_tags else {}), **dependents}
    try:
        check_for_loops(mimics)
    except ValueError as loop:
        raise ValueError(
            f"Joints follow each other in a loop: {loop}. Correct 'dependent_joints'."
        ) from loop
    return mimics


@dataclass
class FreeJoint:
    """The limits and the state of an independent joint; unknown quantities are None."""

    lower: float
    upper: float
    is_continuous: bool
    position: float | None = None
    velocity: float | None = None
    effort: float | None = None
    _direction: int = 1

    @classmethod
    def of(cls, joint: Joint, use_soft_limits: bool) -> FreeJoint:
        """
        Create a joint with the limits of its description and no known values.

        Parameters
        ----------
        joint
            The joint in the URDF.
        use_soft_limits
            Whether to apply the soft limits of `<safety_controller>` as well.

        Returns
        -------
        FreeJoint
            Its limits are in rad or m; -pi and pi for a continuous joint.

        """
        if joint.limits is None:
            return cls(-pi, pi, joint.kind == 'continuous')
        lower, upper = joint.limits.lower, joint.limits.upper
        if use_soft_limits and joint.soft_limits is not None:
            lower = max(lower, joint.soft_limits.lower)
            upper = min(upper, joint.soft_limits.upper)
        return cls(lower, upper, False)

    @property
    def is_known(self) -> bool:
        """Whether the position, velocity or effort is known."""
        return (self.position, self.velocity, self.effort) != (None, None, None)

    @property
    def zero(self) -> float:
        """Return the default position: 0, or the middle of the range if 0 is out of range."""
        return 0.0 if self.lower <= 0.0 <= self.upper else (self.lower + self.upper) / 2.0

    def move(self, delta: float) -> None:
        """
        Advance the position by a step, back and forth between the limits.

        A continuous joint wraps around to the other limit instead. Without a known position, the
        joint does not move.

        Parameters
        ----------
        delta
            The step, in rad or m.

        """
        if self.position is None:
            return
        position = self.position + self._direction * delta
        if not self.lower <= position <= self.upper:
            if self.is_continuous:
                position = self.lower if position > self.upper else self.upper
            else:
                self._direction = -1 if (position > self.upper) == (delta > 0) else 1
                position = min(max(position, self.lower), self.upper)
        self.position = position
