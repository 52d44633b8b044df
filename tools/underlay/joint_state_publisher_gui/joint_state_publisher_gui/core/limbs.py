# SPDX-License-Identifier: Apache-2.0
"""The joints of a robot, grouped by limb."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Sequence
from dataclasses import dataclass
from itertools import takewhile

from joint_state_publisher_gui.core.words import (
    kind_of,
    short_name,
    side_of,
    SIDELESS,
    words_of,
)
from urdf import Joint, RobotModel

__all__ = ['Limb', 'limbs']

MANY = (*SIDELESS, 'hand')
"""Kinds whose branches belong together, such as the fingers of a hand."""


@dataclass(frozen=True)
class Limb:
    """A group of joints in the order of the URDF."""

    title: str
    side: str | None
    joints: tuple[str, ...]

    def label(self, name: str) -> str:
        """
        Shorten the name of a joint for a slider below the title of the limb.

        Parameters
        ----------
        name
            The joint.

        Returns
        -------
        str
            The name without the side with which it begins.

        """
        return short_name(name, self.side)


@dataclass(frozen=True)
class _Group:
    """Which group a joint is in: the side, the kind, and the joint with which a branch begins."""

    side: str | None
    kind: str | None
    first: str | None

    @property
    def title(self) -> str:
        words = ' '.join(word for word in (self.side, self.kind) if word)
        return (words or 'joints').capitalize()


def limbs(model: RobotModel, names: Container[str]) -> list[Limb]:
    """
    Group joints by limb.

    The words of a name tell the side and the kind of limb; what it does not tell is as for the
    joint before it on the same branch.

    Parameters
    ----------
    model
        The robot.
    names
        The joints that are grouped; others are left out.

    Returns
    -------
    list of Limb
        Groups and their joints in the order of the URDF.

    """
    members: dict[_Group, list[str]] = {}
    groups = _groups(model)
    for joint in model.moving_joints:
        if joint.name in names:
            members.setdefault(groups[joint.name], []).append(joint.name)
    repeated = Counter(group.title for group in members)
    return [
        Limb(
            _common(joints) if repeated[group.title] > 1 else group.title,
            group.side,
            tuple(joints),
        )
        for group, joints in members.items()
    ]


def _groups(model: RobotModel) -> dict[str, _Group]:
    """Return the group of each moving joint."""
    above = {joint.child: joint for joint in model.joints}
    before = {joint.name: _moving_before(joint, above) for joint in model.moving_joints}
    branches = Counter(parent.name for parent in before.values() if parent)
    groups: dict[str, _Group] = {}
    for joint in model.moving_joints:
        chain = [joint]
        while chain[-1].name not in groups and (parent := before[chain[-1].name]):
            chain.append(parent)
        for each in reversed(chain):
            parent = before[each.name]
            if each.name not in groups:
                groups[each.name] = _group(
                    each.name,
                    groups[parent.name] if parent else None,
                    bool(parent and branches[parent.name] > 1),
                )
    return groups


def _moving_before(joint: Joint, above: dict[str, Joint]) -> Joint | None:
    """Return the next joint towards the root that moves."""
    parent = above.get(joint.parent)
    while parent is not None and not parent.moves:
        parent = above.get(parent.parent)
    return parent


def _group(name: str, before: _Group | None, is_fork: bool) -> _Group:
    """Return the group of a joint, which may be that of the joint before it."""
    words = words_of(name)
    kind = kind_of(words)
    side = side_of(words, kind)
    if before is not None:
        if kind is None and (not is_fork or before.kind == 'hand'):
            kind = before.kind
        if side is None and kind not in SIDELESS:
            side = before.side
        if (side, kind) == (before.side, before.kind) and (kind is not None or not is_fork):
            return before
    # Both hands, and what is on both sides, are told apart by the side.
    return _Group(side, kind, None if kind in MANY or side is not None else name)


def _common(names: Sequence[str]) -> str:
    """Return how the names of a group begin, or else the first one."""
    same = takewhile(lambda letters: len(set(letters)) == 1, zip(*names))
    return ''.join(letters[0] for letters in same).rstrip('_-./') or names[0]
