# SPDX-License-Identifier: Apache-2.0
"""Grouping of the joints of a robot by limb."""

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
"""Kinds of limbs whose branches form one group, such as the fingers of a hand."""


@dataclass(frozen=True)
class Limb:
    """A group of joints in the order of the URDF."""

    title: str
    side: str | None
    joints: tuple[str, ...]

    def label(self, name: str) -> str:
        """
        Shorten the name of a joint for a slider under the title of the limb.

        Parameters
        ----------
        name
            The joint.

        Returns
        -------
        str
            The name without the prefix for the side.

        """
        return short_name(name, self.side)


@dataclass(frozen=True)
class _Group:
    """Key of a group of joints: the side, the kind and the first joint of a branch."""

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

    The side and the kind of limb are derived from the words of the joint name. Whatever the name
    lacks is inherited from the preceding joint on the same branch.

    Parameters
    ----------
    model
        The robot.
    names
        The joints to group; others are left out.

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
    """Compute the group of each movable joint."""
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
    """Return the nearest movable joint towards the root."""
    parent = above.get(joint.parent)
    while parent is not None and not parent.moves:
        parent = above.get(parent.parent)
    return parent


def _group(name: str, before: _Group | None, is_fork: bool) -> _Group:
    """Return the group of a joint, possibly that of the preceding joint."""
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
    # Hands, and other limbs that exist on both sides, are distinguished by the side.
    return _Group(side, kind, None if kind in MANY or side is not None else name)


def _common(names: Sequence[str]) -> str:
    """Return the common prefix of the names of a group, or the first name."""
    same = takewhile(lambda letters: len(set(letters)) == 1, zip(*names))
    return ''.join(letters[0] for letters in same).rstrip('_-./') or names[0]
