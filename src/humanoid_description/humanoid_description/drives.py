# SPDX-License-Identifier: Apache-2.0
"""
The drives of the humanoid's joints, as config/joints.yaml says.

The model is made from the same file: who reads the drives here knows what the model knows, and
the gains of the servos as well, for which a URDF has no place.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

from humanoid_description.files import load_config
from humanoid_description.scaling import load_scaling, Scaling

SIDES = ('left', 'right')


@dataclass(frozen=True)
class Drive:
    """What moves a joint: its range, its strength and the gains of its servo."""

    lower_rad: float
    upper_rad: float
    effort_nm: float
    velocity_rad_s: float
    damping_nms_rad: float
    friction_nm: float
    kp_nm_rad: float
    kd_nms_rad: float
    armature_kgm2: float


def load_drives(
    scale: float = 1.0, prefix: str = '', upper_body_only: bool = False
) -> dict[str, Drive]:
    """Return the drive of every joint of the humanoid that the arguments describe."""
    drives = drives_of(load_config('joints.yaml'), load_scaling(), scale, upper_body_only)
    return {prefix + name: drive for name, drive in drives.items()}


def drives_of(
    table: Mapping[str, Any], scaling: Scaling, scale: float, upper_body_only: bool
) -> dict[str, Drive]:
    """Build the drives from the content of the file."""
    limbs = ('arm',) if upper_body_only else ('arm', 'leg')
    return {
        name: _drive(entry, table['dynamics'], _Factors(scaling, scale), mirrored)
        for name, entry, mirrored in _entries(table, limbs)
    }


def _entries(
    table: Mapping[str, Any], limbs: tuple[str, ...]
) -> Iterator[tuple[str, Mapping[str, Any], bool]]:
    """Yield every joint: its name, its entry, and whether it turns the other way."""
    for name, entry in table['middle'].items():
        yield name, entry, False
    for side in SIDES:
        for limb in limbs:
            for kind, entry in table[limb].items():
                yield f'{side}_{kind}', entry, side == 'right' and entry['axis'] != 'y'


@dataclass(frozen=True)
class _Factors:
    """Multiplies values by what the scale makes of their quantity."""

    scaling: Scaling
    scale: float

    def of(self, values: Mapping[str, float], quantity: str) -> float:
        """Return the value of a quantity, at the scale."""
        return values[quantity] * self.scaling.factor(quantity, self.scale)


def _drive(
    entry: Mapping[str, Any], dynamics: Mapping[str, float], scaled: _Factors, mirrored: bool
) -> Drive:
    """Build one drive."""
    limit, servo = entry['limit'], entry['servo']
    lower, upper = limit['lower'], limit['upper']
    return Drive(
        lower_rad=-upper if mirrored else lower,
        upper_rad=-lower if mirrored else upper,
        effort_nm=scaled.of(limit, 'effort'),
        velocity_rad_s=scaled.of(limit, 'velocity'),
        damping_nms_rad=scaled.of(dynamics, 'damping'),
        friction_nm=scaled.of(dynamics, 'friction'),
        kp_nm_rad=scaled.of(servo, 'kp'),
        kd_nms_rad=scaled.of(servo, 'kd'),
        armature_kgm2=scaled.of(servo, 'armature'),
    )
