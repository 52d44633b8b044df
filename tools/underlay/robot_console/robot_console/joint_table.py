# SPDX-License-Identifier: Apache-2.0
"""The joints of a robot by limb: states, targets and how close they are to limits; without ROS."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from joint_state_publisher_gui.limbs import Limb, limbs
from robot_console.joint_states import JointState, JointStates
from rviz_common.status import Level
from urdf import Joint, Limits, RobotModel

__all__ = ['JointRow', 'JointTable', 'RowGroup', 'load_level', 'position_level']

UNKNOWN = JointState()
NEAR = 0.9
NEAR_LIMIT = 0.05

STALE_S = 1.0


@dataclass(frozen=True)
class JointRow:
    """Measured state, commanded position and description of a joint."""

    name: str
    label: str
    joint: Joint | None = None
    state: JointState = UNKNOWN
    target: float | None = None
    is_stale: bool = False

    @property
    def is_angle(self) -> bool:
        """Whether positions are angles; joints without a description are taken as revolute."""
        return self.joint is None or self.joint.kind != 'prismatic'

    @property
    def limits(self) -> Limits | None:
        """Return the position limits of the joint."""
        limits = self.joint.limits if self.joint else None
        return limits if limits and limits.lower < limits.upper else None

    @property
    def error(self) -> float | None:
        """Return the position error: target minus measured position."""
        if self.target is None or self.state.position is None:
            return None
        return self.target - self.state.position

    def share(self, position: float | None) -> float | None:
        """
        Scale a position to the range of the joint.

        Parameters
        ----------
        position
            In rad or m; None if unknown.

        Returns
        -------
        float or None
            0 at or below the lower limit, 1 at or above the upper limit; None without a position
            or limits.

        """
        if position is None or self.limits is None:
            return None
        span = self.limits.upper - self.limits.lower
        return min(max((position - self.limits.lower) / span, 0.0), 1.0)


def position_level(row: JointRow) -> Level:
    """
    Rate the proximity of a joint to its position limits.

    Parameters
    ----------
    row
        The joint.

    Returns
    -------
    Level
        WARN within 5 % of the range from a limit, ERROR beyond the limits, otherwise OK.

    """
    position, limits = row.state.position, row.limits
    if position is None or limits is None:
        return Level.OK
    if not limits.lower <= position <= limits.upper:
        return Level.ERROR
    margin = NEAR_LIMIT * (limits.upper - limits.lower)
    is_near = min(position - limits.lower, limits.upper - position) < margin
    return Level.WARN if is_near else Level.OK


def load_level(value: float | None, maximum: float | None) -> Level:
    """
    Rate the proximity of a velocity or an effort to its maximum.

    Parameters
    ----------
    value
        The measured value, of either sign; None if unknown.
    maximum
        The maximum magnitude, in the same unit; None if there is no limit.

    Returns
    -------
    Level
        WARN from 90 % of the maximum, ERROR beyond it, otherwise OK.

    """
    if value is None or maximum is None or abs(value) < NEAR * maximum:
        return Level.OK
    return Level.ERROR if abs(value) > maximum else Level.WARN


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
