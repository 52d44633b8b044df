# SPDX-License-Identifier: Apache-2.0
"""Commands from outside: taken as a whole when sound, or refused as a whole with the reason."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.backends import Array, JointTargets
import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.intp]
LARGEST = 1e6
"""No joint gets near to it in any unit; beyond, sums of values may overflow."""


class CommandError(ValueError):
    """Refuse a command, in sentences that say what is wrong and what to do."""


@dataclass(frozen=True, eq=False)
class PartialTargets:
    """Targets of some joints of a robot: their places among all joints, (m,), and m targets."""

    places: Indices
    targets: JointTargets


class JointNames:
    """The joints of a robot, by which commands from outside are checked."""

    def __init__(self, joints: Sequence[str]) -> None:
        """Remember the places of the joints."""
        self.joints = tuple(joints)
        self._place_of = {joint: place for place, joint in enumerate(joints)}

    def places(self, names: Sequence[str]) -> Indices:
        """Return the places of some joints; refuse none, unknown ones and repeated ones."""
        if not names:
            raise CommandError('It names no joint. Name those that are to move.')
        for name in names:
            if name not in self._place_of:
                raise CommandError(self._unknown(name))
        places = np.array([self._place_of[name] for name in names], dtype=np.intp)
        if len(set(names)) < len(names):
            twice = next(name for name in names if list(names).count(name) > 1)
            raise CommandError(f"It names '{twice}' more than once. Name every joint once.")
        return places

    def targets(
        self,
        names: Sequence[str],
        positions_rad: Sequence[float],
        velocities_rad_s: Sequence[float] = (),
        efforts_nm: Sequence[float] = (),
    ) -> PartialTargets:
        """Return the targets of a command; velocities and efforts that are not given are zero."""
        places = self.places(names)
        targets = JointTargets(
            checked_values('position', positions_rad, names),
            optional_values('velocity', velocities_rad_s, names),
            optional_values('effort', efforts_nm, names),
        )
        return PartialTargets(places, targets)

    def _unknown(self, name: str) -> str:
        """Build the sentence on a joint that there is not."""
        advice = did_you_mean(name, self.joints) or f'It has: {", ".join(self.joints)}.'
        return f"The robot has no joint '{shortened(name)}'. {advice}"


def optional_values(field: str, values: Sequence[float], names: Sequence[str]) -> Array:
    """Return values that may be left out, which means zero."""
    return checked_values(field, values, names) if len(values) else np.zeros(len(names))


def checked_values(field: str, values: Sequence[float], names: Sequence[str]) -> Array:
    """Return one finite value a joint, none of them absurd, or refuse them."""
    if len(values) != len(names):
        raise CommandError(
            f"Its field '{field}' has length {len(values)}, but it names {len(names)} joints. "
            'Give one value a joint.'
        )
    array = np.array(values, dtype=np.float64)
    finite = np.isfinite(array)
    if not finite.all():
        place = int(np.argmin(finite))
        raise CommandError(
            f"The {field} of '{names[place]}' is {array[place]}. Give finite numbers."
        )
    sizes = np.abs(array)
    if sizes.max() > LARGEST:
        place = int(np.argmax(sizes))
        raise CommandError(
            f"The {field} of '{names[place]}' is {array[place]:g}, beyond all that a joint can "
            f'do. Give at most {LARGEST:g}.'
        )
    return array
