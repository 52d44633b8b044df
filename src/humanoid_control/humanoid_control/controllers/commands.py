# SPDX-License-Identifier: Apache-2.0
"""Joint commands from outside: each is accepted or rejected as a whole."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from humanoid_common.errors import UserError
from humanoid_common.naming import did_you_mean, shortened
from humanoid_control.backends import Array, JointTargets
import numpy as np
from numpy.typing import NDArray

Indices = NDArray[np.intp]
LARGEST = 1e6
"""Far beyond any joint value in any unit; sums of larger values may overflow."""


class CommandError(UserError):
    """A command was rejected; the message states what is wrong and what to do."""


@dataclass(frozen=True, eq=False)
class PartialTargets:
    """Targets of m joints of a robot, with their indices (m,) among all joints."""

    indices: Indices
    targets: JointTargets


class JointNames:
    """
    Joint names of a robot, against which joint commands are checked.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.

    """

    def __init__(self, joints: Sequence[str]) -> None:
        self.joints = tuple(joints)
        self._index_of = {joint: index for index, joint in enumerate(joints)}

    def indices(self, names: Sequence[str]) -> Indices:
        """
        Look up the indices of joints by their names.

        Parameters
        ----------
        names
            Names of m joints, in any order.

        Returns
        -------
        Indices
            Index (m,) of each among all joints of the robot.

        Raises
        ------
        CommandError
            The list is empty, or a name is unknown or repeated.

        """
        if not names:
            raise CommandError('It names no joints. Name those to move.')
        for name in names:
            if name not in self._index_of:
                raise CommandError(self._unknown(name))
        indices = np.array([self._index_of[name] for name in names], dtype=np.intp)
        if len(set(names)) < len(names):
            twice = next(name for name in names if list(names).count(name) > 1)
            raise CommandError(f"It names '{twice}' more than once. Name every joint once.")
        return indices

    def targets(
        self,
        names: Sequence[str],
        positions_rad: Sequence[float],
        velocities_rad_s: Sequence[float] = (),
        efforts_nm: Sequence[float] = (),
    ) -> PartialTargets:
        """
        Check a joint command and convert it to targets.

        Parameters
        ----------
        names
            Names of the m commanded joints.
        positions_rad, velocities_rad_s, efforts_nm
            One value per name; m, m/s and N for prismatic joints. Velocities and efforts may be
            empty, which means zero.

        Returns
        -------
        PartialTargets
            Indices and targets of the m joints.

        Raises
        ------
        CommandError
            A name is unknown or repeated, or a field has the wrong length or holds values that are
            not finite or beyond `LARGEST`.

        """
        indices = self.indices(names)
        targets = JointTargets(
            checked_values('position', positions_rad, names),
            optional_values('velocity', velocities_rad_s, names),
            optional_values('effort', efforts_nm, names),
        )
        return PartialTargets(indices, targets)

    def _unknown(self, name: str) -> str:
        """Build the message about an unknown joint."""
        advice = did_you_mean(name, self.joints) or f'It has: {", ".join(self.joints)}.'
        return f"The robot has no joint '{shortened(name)}'. {advice}"


def optional_values(field: str, values: Sequence[float], names: Sequence[str]) -> Array:
    """
    Check the values of a field that may be empty, which means zero.

    Parameters
    ----------
    field
        Name of the field, for the error message.
    values, names
        One value for each of the m names, or none at all.

    Returns
    -------
    Array
        The values (m,).

    Raises
    ------
    CommandError
        As for `checked_values`.

    """
    return checked_values(field, values, names) if len(values) else np.zeros(len(names))


def checked_values(field: str, values: Sequence[float], names: Sequence[str]) -> Array:
    """
    Check that a field has one finite value of plausible magnitude per joint.

    Parameters
    ----------
    field
        Name of the field, for the error message.
    values, names
        The values, and the m joints that they belong to.

    Returns
    -------
    Array
        The values (m,).

    Raises
    ------
    CommandError
        The number of values is not m, or one is not finite or beyond `LARGEST`.

    """
    if len(values) != len(names):
        raise CommandError(
            f"Its field '{field}' has length {len(values)}, but it names {len(names)} joints. "
            'Give one value per joint.'
        )
    array = np.array(values, dtype=np.float64)
    finite = np.isfinite(array)
    if not finite.all():
        index = int(np.argmin(finite))
        raise CommandError(
            f"The {field} of '{names[index]}' is {array[index]}. Give finite numbers."
        )
    sizes = np.abs(array)
    if sizes.max() > LARGEST:
        index = int(np.argmax(sizes))
        raise CommandError(
            f"The {field} of '{names[index]}' is {array[index]:g}, beyond the limits of any "
            f'joint. Give at most {LARGEST:g}.'
        )
    return array
