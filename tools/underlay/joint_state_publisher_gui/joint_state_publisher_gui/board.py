# SPDX-License-Identifier: Apache-2.0
"""The sliders of a robot."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import pi
from random import Random

from joint_state_publisher.merged_joints import FreeJoint, MergedJoints
from joint_state_publisher_gui.joint_slider import JointSlider, Scale
from joint_state_publisher_gui.limbs import Limb, limbs
from joint_state_publisher_gui.poses import Pose
from ros_environment.suggestions import did_you_mean
from urdf import Joint, RobotModel

__all__ = ['Board']

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

    def apply(self, pose: Pose) -> list[str]:
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
