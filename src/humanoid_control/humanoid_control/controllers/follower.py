# SPDX-License-Identifier: Apache-2.0
"""Controller that follows streamed joint commands until they time out."""

from __future__ import annotations

from collections.abc import Sequence

from humanoid_control.backends import JointTargets, Observation
from humanoid_control.controllers.commands import Clock, PartialTargets, Silence
from humanoid_control.controllers.interface import Mask
import numpy as np

TIMEOUT_S = 0.5


class Follower:
    """
    Controller that follows a stream of joint commands, and releases joints when it stops.

    It claims each joint until the timeout has passed since the last command for it. A command for
    some joints leaves the targets of the others unchanged.

    Parameters
    ----------
    joints
        All joints of the robot, in the order of its targets.
    timeout_s
        How long a joint stays claimed after the last command for it.
    clock
        Returns the computer's time in s, by which the timeout must have passed as well; without it
        only the robot's time counts.
    name
        Name of the controller, as shown to users.

    """

    way_out = 'wait until its commands end'

    def __init__(
        self,
        joints: Sequence[str],
        timeout_s: float = TIMEOUT_S,
        clock: Clock | None = None,
        name: str = 'joint_commands',
    ) -> None:
        self.name = name
        self.joints = tuple(joints)
        self._timeout_s, self._clock = timeout_s, clock
        self._silences: dict[tuple[int, ...], tuple[Mask, Silence]] = {}
        rest = np.zeros(len(self.joints))
        self._targets = JointTargets(rest, rest.copy(), rest.copy())

    @property
    def waits(self) -> bool:
        """Whether a start is pending: never, as the targets come with the commands."""
        return False

    def start(self, observation: Observation, held: JointTargets) -> None:
        """
        Start the controller; a no-op, as the targets come with the commands.

        Parameters
        ----------
        observation, held
            As for `Controller.start`; not used.

        """

    def accept(self, command: PartialTargets) -> None:
        """
        Store a command, which takes effect in the next period.

        Parameters
        ----------
        command
            Checked targets of some joints, whose timeout restarts; other joints keep theirs.

        """
        targets, indices = self._targets, command.indices
        targets.positions_rad[indices] = command.targets.positions_rad
        targets.velocities_rad_s[indices] = command.targets.velocities_rad_s
        targets.efforts_nm[indices] = command.targets.efforts_nm
        self._silence_of(indices.tolist()).heard()

    def wanted(self, now_s: float) -> Mask:
        """
        Compute the mask of joints whose commands have not timed out.

        Parameters
        ----------
        now_s
            The robot's time.

        Returns
        -------
        Mask
            Over all joints (n,).

        """
        self._silences = {
            key: entry for key, entry in self._silences.items() if not entry[1].lasts(now_s)
        }
        masks = [mask for mask, _ in self._silences.values()]
        wanted: Mask = np.logical_or.reduce(masks) if masks else self._mask([])
        return wanted

    def update(self, observation: Observation) -> JointTargets:
        """
        Return the latest commanded targets.

        Parameters
        ----------
        observation
            Not used.

        Returns
        -------
        JointTargets
            Targets of all n joints; entries of joints that are not `wanted` are to be ignored.

        """
        return self._targets

    def cancel(self) -> None:
        """Drop all commands."""
        self._silences = {}

    def _silence_of(self, indices: list[int]) -> Silence:
        """Return the timeout of a set of joints that are commanded together."""
        key = tuple(indices)
        if key not in self._silences:
            self._silences[key] = (self._mask(indices), Silence(self._timeout_s, self._clock))
        return self._silences[key][1]

    def _mask(self, indices: list[int]) -> Mask:
        mask = np.zeros(len(self.joints), dtype=np.bool_)
        mask[indices] = True
        return mask
