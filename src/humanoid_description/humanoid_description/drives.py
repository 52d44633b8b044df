# SPDX-License-Identifier: Apache-2.0
"""
The drives (actuators) of the humanoid's joints, and how they and the robot grow with its size.

They are read from config/joints.yaml and config/scaling.yaml. The URDF is generated from the same
files, so both agree. The drives also have the servo gains, for which a URDF has no element.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Any

from humanoid_description.errors import DescriptionError
from humanoid_description.expansion import load_config

SIDES = ('left', 'right')
REVOLUTE, PRISMATIC = 'revolute', 'prismatic'


@dataclass(frozen=True)
class Drive:
    """
    The actuator of a joint.

    Attributes
    ----------
    lower, upper
        Position limits: rad, or m for a prismatic joint.
    effort, velocity
        Effort limit, in N m or N, and velocity limit, in rad/s or m/s.
    damping, friction
        Damping and dry friction of the joint itself: N m s/rad or N s/m, and N m or N.
    kp, kd
        Proportional and derivative gain of its servo: N m/rad or N/m, and N m s/rad or N s/m.
    armature
        Rotor inertia reflected to the joint: kg m2, or kg.
    kind
        The type of the joint, as in a URDF: `revolute` or `prismatic`.

    """

    lower: float
    upper: float
    effort: float
    velocity: float
    damping: float
    friction: float
    kp: float
    kd: float
    armature: float
    kind: str = REVOLUTE


def load_drives(
    scale: float = 1.0, prefix: str = '', upper_body_only: bool = False, hands: bool = False
) -> dict[str, Drive]:
    """
    Return the drive of every joint of a humanoid.

    Parameters
    ----------
    scale, prefix, upper_body_only, hands
        The arguments of the model. Joints that mimic others have no drive.

    Raises
    ------
    DescriptionError
        The scale is out of range.

    """
    limbs = ('arm', *(('hand',) if hands else ()), *(() if upper_body_only else ('leg',)))
    drives = drives_of(load_config('joints.yaml'), load_scaling(), scale, limbs)
    return {prefix + name: drive for name, drive in drives.items()}


def leg_joints() -> tuple[str, ...]:
    """Return the names of the joints of the legs, the left one first, without a prefix."""
    above = load_drives(upper_body_only=True)
    return tuple(joint for joint in load_drives() if joint not in above)


def drives_of(
    table: Mapping[str, Any], scaling: Scaling, scale: float, limbs: Sequence[str]
) -> dict[str, Drive]:
    """
    Build the drives of the trunk, the head and some limbs from the content of joints.yaml.

    Parameters
    ----------
    table
        The content of the file.
    scaling, scale
        The scaling rules, and the size of the robot, 1.0 for the values of the file.
    limbs
        The limbs to include: `arm`, `hand`, `leg`, each on both sides.

    Returns
    -------
    dict of Drive
        The drives by the names of their joints, without a prefix.

    Raises
    ------
    DescriptionError
        The scale is out of range.

    """
    return {
        name: _drive(entry, table['dynamics'], scaling, scale, mirrored)
        for name, entry, mirrored in _entries(table, limbs)
    }


def _entries(
    table: Mapping[str, Any], limbs: Sequence[str]
) -> Iterator[tuple[str, Mapping[str, Any], bool]]:
    """Yield every joint: its name, its entry, and whether its limits are mirrored."""
    for name, entry in table['middle'].items():
        yield name, entry, False
    for side in SIDES:
        for limb in limbs:
            for kind, entry in table[limb].items():
                turned = _kind(entry) == REVOLUTE and entry['axis'] != 'y'
                yield f'{side}_{kind}', entry, side == 'right' and turned


def _kind(entry: Mapping[str, Any]) -> str:
    """Return the type of a joint."""
    return str(entry.get('type', REVOLUTE))


def _drive(
    entry: Mapping[str, Any],
    dynamics: Mapping[str, Any],
    scaling: Scaling,
    scale: float,
    mirrored: bool,
) -> Drive:
    """Build one drive."""
    kind = _kind(entry)
    limit, servo, common = entry['limit'], entry['servo'], dynamics[kind]
    lower, upper = limit['lower'], limit['upper']
    grown = partial(scaling.joint_factor, kind, scale=scale)
    return Drive(
        lower=(-upper if mirrored else lower) * grown('travel'),
        upper=(-lower if mirrored else upper) * grown('travel'),
        effort=limit['effort'] * grown('effort'),
        velocity=limit['velocity'] * grown('velocity'),
        damping=common['damping'] * grown('damping'),
        friction=common['friction'] * grown('friction'),
        kp=servo['kp'] * grown('kp'),
        kd=servo['kd'] * grown('kd'),
        armature=servo['armature'] * grown('armature'),
        kind=kind,
    )


@dataclass(frozen=True)
class Scaling:
    """The range of the scale, and the exponent of the scale by which each quantity grows."""

    smallest: float
    largest: float
    exponents: Mapping[str, Any]
    """By quantity; those of joints by type of joint and quantity."""

    def joint_factor(self, kind: str, quantity: str, scale: float) -> float:
        """
        Compute the factor of a joint quantity in a robot of another size.

        Parameters
        ----------
        kind
            The type of the joint: `revolute` or `prismatic`.
        quantity
            Such as `effort`, `velocity` or `kp`: the names are those in scaling.yaml.
        scale
            The size of the robot relative to the model at 1.0.

        Raises
        ------
        DescriptionError
            The scale is out of range.

        """
        self.check(scale)
        return float(scale ** self.exponents[kind][quantity])

    def check(self, scale: float) -> None:
        """
        Reject a scale that is out of range.

        Parameters
        ----------
        scale
            The size of the robot relative to the model at 1.0.

        Raises
        ------
        DescriptionError
            The scale is less than the smallest or more than the largest.

        """
        if not self.smallest <= scale <= self.largest:
            raise DescriptionError(
                f'The scale {scale:g} is out of range. '
                f'Give one from {self.smallest} to {self.largest}.'
            )


def load_scaling() -> Scaling:
    """Load the installed scaling rules."""
    return Scaling(**load_config('scaling.yaml'))
