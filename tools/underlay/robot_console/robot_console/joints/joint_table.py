# SPDX-License-Identifier: Apache-2.0
"""The joints of a robot with their states, grouped by limb."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from joint_state_publisher_gui.core.limbs import Limb, limbs
from robot_console.joints.joint_row import JointRow
from robot_console.joints.joint_state import JointState, JointStates
from urdf import RobotModel

__all__ = ['JointTable', 'RowGroup']

STALE_S = 1.0
UNKNOWN = JointState()


@dataclass(frozen=True)
class RowGroup:
    """The rows of a limb."""

    title: str
    rows: tuple[JointRow, ...]


class JointTable:
    """Combines measured states, commanded positions and the robot description."""

    def __init__(self) -> None:
        self.measured = JointStates()
        self.commanded = JointStates()
        self._model: RobotModel | None = None
        self._limbs: tuple[frozenset[str], list[Limb]] = frozenset(), []

    def describe(self, model: RobotModel) -> None:
        """
        Set the robot description, which provides limbs, joint types and limits.

        Parameters
        ----------
        model
            The robot.

        """
        self._model = model
        self._limbs = frozenset(), []

    @property
    def is_described(self) -> bool:
        """Whether a robot description was received."""
        return self._model is not None

    def groups(self, now_s: float, search: str = '') -> list[RowGroup]:
        """
        Build the rows of the table, grouped by limb.

        Commanded positions older than a second are omitted; measured states older than that are
        marked stale.

        Parameters
        ----------
        now_s
            The current time, from `time.time`.
        search
            Text that the name or the limb title of a listed joint must contain; case-insensitive,
            with spaces equal to underscores.

        """
        measured, commanded = self.measured.states, self.commanded.states
        joints = {joint.name: joint for joint in self._model.joints} if self._model else {}
        wanted = search.strip().lower().replace(' ', '_')

        def row(name: str, label: str) -> JointRow:
            state, told = measured.get(name, UNKNOWN), commanded.get(name, UNKNOWN)
            is_told = now_s - told.at_s < STALE_S
            return JointRow(
                name,
                label,
                joints.get(name),
                state,
                told.position if is_told else None,
                now_s - state.at_s > STALE_S,
            )

        groups = []
        for limb in self._grouped(measured, commanded):
            title = limb.title.lower().replace(' ', '_')
            shown = [name for name in limb.joints if wanted in f'{title} {name.lower()}']
            if shown:
                rows = tuple(row(name, limb.label(name)) for name in shown)
                groups.append(RowGroup(limb.title, rows))
        return groups

    def _grouped(self, *told: Mapping[str, JointState]) -> Sequence[Limb]:
        """Return the limbs, which are recomputed only when the set of joints changes."""
        names = frozenset().union(*told)
        if self._model is not None:
            names = names.union(joint.name for joint in self._model.moving_joints)
        if self._limbs[0] != names:
            self._limbs = names, _limbs(self._model, names)
        return self._limbs[1]


def _limbs(model: RobotModel | None, names: frozenset[str]) -> list[Limb]:
    known = limbs(model, names) if model is not None else []
    rest = names.difference(*(limb.joints for limb in known))
    title = 'Not in the robot description' if model is not None else 'Joints'
    return [*known, *([Limb(title, None, tuple(sorted(rest)))] if rest else [])]
