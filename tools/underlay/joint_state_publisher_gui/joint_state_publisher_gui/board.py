# SPDX-License-Identifier: Apache-2.0
"""The sliders of a robot: by limb, each with the scale of its joint."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import ceil, degrees, floor, isfinite, log10, pi
from random import Random

from joint_state_publisher.merged_joints import FreeJoint, MergedJoints
from joint_state_publisher_gui.limbs import Limb, limbs
from ros_environment.suggestions import did_you_mean
from urdf import Joint, RobotModel

__all__ = ['Board', 'JointSlider', 'Scale']

WIDEST = 1e4


class Board:
    """
    The sliders of all independent joints, grouped by limb.

    Parameters
    ----------
    model
        The robot.
    joints
        Its joint states, which the sliders set and display.

    Attributes
    ----------
    robot
        The name of the robot.
    limbs
        The groups of joints.
    sliders
        The sliders by the names of their joints, in the order of the URDF.

    """

    def __init__(self, model: RobotModel, joints: MergedJoints) -> None:
        self.robot = model.name
        self.limbs: list[Limb] = limbs(model, joints.free)
        self._moving = {joint.name for joint in model.moving_joints}
        self.sliders = {
            joint.name: JointSlider(
                joint.name,
                joints.free[joint.name],
                _scale(joint, joints.free[joint.name]),
                joints.defaults[joint.name],
            )
            for joint in model.moving_joints
            if joint.name in joints.free
        }

    def found(self, text: str) -> list[Limb]:
        """
        Search for joints by keywords.

        Parameters
        ----------
        text
            Keywords, each of which must occur in the name of a joint or the title of its limb.

        Returns
        -------
        list of Limb
            The limbs with the matching joints; all limbs for an empty text.

        """
        words = text.lower().split()
        found = []
        for limb in self.limbs:
            joints = tuple(
                name
                for name in limb.joints
                if all(word in f'{limb.title} {name}'.lower() for word in words)
            )
            if joints:
                found.append(Limb(limb.title, limb.side, joints))
        return found

    def centre(self) -> None:
        """Move all joints to their default positions."""
        for slider in self.sliders.values():
            slider.move(slider.default)

    def zero(self) -> None:
        """Move all joints to 0, or to the nearest limit."""
        for slider in self.sliders.values():
            slider.move(0.0)

    def randomise(self, random: Random) -> None:
        """
        Move each joint to a random position within its limits.

        Parameters
        ----------
        random
            The random number generator.

        """
        for slider in self.sliders.values():
            slider.move(random.uniform(slider.scale.lower, slider.scale.upper))

    def pose(self) -> dict[str, float]:
        """Return the positions of all joints that have a slider."""
        return {name: slider.position for name, slider in self.sliders.items()}

    def apply(self, pose: Mapping[str, float]) -> list[str]:
        """
        Move joints to a saved pose, clamped to their limits.

        Parameters
        ----------
        pose
            Positions by joint name, in rad or m.

        Returns
        -------
        list of str
            A message for each joint that has no slider or stops at a limit.

        """
        return list(self._apply(pose))

    def _apply(self, pose: Mapping[str, float]) -> Iterator[str]:
        for name, position in pose.items():
            slider = self.sliders.get(name)
            if slider is None:
                why = 'follows another joint' if name in self._moving else 'is not a moving joint'
                yield (
                    f"'{name}' is skipped: it {why} of this robot. "
                    f'{did_you_mean(name, self.sliders, 0.75)}'.rstrip()
                )
                continue
            slider.move(position)
            if slider.position != position:
                yield f"'{name}' stops at its limit: {position:g} is not within the limits."


def _scale(joint: Joint, free: FreeJoint) -> Scale:
    """Return the scale of a slider, with a usable range even where the limits are huge."""
    is_angle = joint.kind != 'prismatic'
    lower, upper = sorted((free.lower, free.upper))
    if upper - lower <= WIDEST:
        return Scale(lower, upper, is_angle)
    middle, reach = min(max(0.0, lower), upper), pi if is_angle else 1.0
    return Scale(max(lower, middle - reach), min(upper, middle + reach), is_angle)


DECIMALS = 3
MOST_DECIMALS = 9
STEPS = 100
"""Minimum number of steps of a slider."""


class JointSlider:
    """
    The slider of a joint.

    A slider that a user drags already shows its new value. Therefore, `news` reports only changes
    from other sources, and user input is not echoed.

    Parameters
    ----------
    name
        The joint.
    joint
        The state of the joint, which the slider sets.
    scale
        The limits and the rounding of positions.
    default
        The position shown while none is known, in rad or m.

    """

    def __init__(self, name: str, joint: FreeJoint, scale: Scale, default: float) -> None:
        self.name = name
        self.scale = scale
        self.default = default
        self._joint = joint
        self._seen = self.shown

    @property
    def position(self) -> float:
        """Return the joint position, in rad or m."""
        return self.default if self._joint.position is None else self._joint.position

    @property
    def shown(self) -> float:
        """Return the value that the slider should display."""
        return self.scale.shown(self.position)

    def give(self, shown: float) -> None:
        """
        Move the joint to the position to which a user has dragged the slider.

        Parameters
        ----------
        shown
            The value of the slider, in rad or m; non-finite values are ignored.

        """
        if isfinite(shown):
            self._joint.position = self.scale.meant(shown)
            self._seen = shown

    def move(self, position: float) -> None:
        """
        Move the joint to a position, clamped to its limits.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        self._joint.position = self.scale.within(position)

    def news(self) -> float | None:
        """Return the value of the slider if it has changed since the last call, else None."""
        shown = self.shown
        if shown == self._seen:
            return None
        self._seen = shown
        return shown


@dataclass(frozen=True)
class Scale:
    """
    Range of a slider between the limits of a joint, in rad or m, with its rounding.

    A slider shows few decimals, and its ends are rounded to lie within the limits; moving it to an
    end selects the exact limit.
    """

    lower: float
    upper: float
    is_angle: bool = True

    @property
    def decimals(self) -> int:
        """Return the number of decimals; it exceeds the default only for narrow limits."""
        width = self.upper - self.lower
        if width <= 0.0:
            return MOST_DECIMALS
        return min(max(DECIMALS, ceil(log10(STEPS / width))), MOST_DECIMALS)

    @property
    def step(self) -> float:
        """Return the increment of the slider."""
        return float(10.0**-self.decimals)

    @property
    def ends(self) -> tuple[float, float]:
        """Return the ends of the slider."""
        if self.upper - self.lower < self.step:
            return self.lower, self.upper
        factor = 10**self.decimals
        # The tolerance absorbs floating-point error, so that a limit is shown as it was written.
        first, last = self.lower * factor, self.upper * factor
        return ceil(first - 1e-6) / factor, floor(last + 1e-6) / factor

    def within(self, position: float) -> float:
        """
        Clamp a position to the limits.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        return min(max(position, self.lower), self.upper)

    def shown(self, position: float) -> float:
        """
        Convert a position to the value of the slider, rounded and clamped to its ends.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        first, last = self.ends
        return min(max(round(position, self.decimals), first), last)

    def meant(self, shown: float) -> float:
        """
        Convert the value of the slider to a position; the ends map to the exact limits.

        Parameters
        ----------
        shown
            The value of the slider, in rad or m.

        """
        first, last = self.ends
        if shown <= first:
            return self.lower
        return self.upper if shown >= last else shown

    def in_words(self, position: float) -> str:
        """
        Format a position in whole degrees or millimetres.

        Parameters
        ----------
        position
            The position in rad or m.

        """
        number = degrees(position) if self.is_angle else position * 1000.0
        return f'{round(number)}°' if self.is_angle else f'{round(number)}\u00a0mm'

    def describe(self) -> str:
        """Format the limits in both units."""
        unit = 'rad' if self.is_angle else 'm'
        return (
            f'{self.lower:.{self.decimals}f} to {self.upper:.{self.decimals}f} {unit} '
            f'({self.in_words(self.lower)} to {self.in_words(self.upper)})'
        )
