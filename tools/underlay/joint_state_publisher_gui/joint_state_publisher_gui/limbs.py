# SPDX-License-Identifier: Apache-2.0
"""Grouping of the joints of a robot by limb, from the words in their names."""

from __future__ import annotations

from collections import Counter
from collections.abc import Container, Sequence
from dataclasses import dataclass
from itertools import takewhile
import re

from urdf import Joint, RobotModel

__all__ = ['SIDELESS', 'Limb', 'kind_of', 'limbs', 'short_name', 'side_of', 'words_of']

KINDS = {
    'hand': 'hand gripper finger thumb palm knuckle index ring pinky',
    'arm': 'arm shoulder elbow wrist forearm upperarm',
    'leg': 'leg hip knee ankle thigh calf shank shin foot toe',
    'head': 'head neck eye jaw gaze',
    'wheels': 'wheel caster',
    'torso': 'torso waist spine chest trunk back abdomen',
}
"""Kinds of limbs with their keywords; the first kind with a keyword in the name applies."""
SIDES = {'left': 'left', 'right': 'right', 'l': 'left', 'r': 'right'}
CORNERS = {
    f'{end}{side}': f'{name} {SIDES[side]}'
    for end, name in (('f', 'front'), ('r', 'rear'), ('h', 'hind'), ('b', 'back'))
    for side in 'lr'
}
CORNERS |= {word[::-1]: corner for word, corner in CORNERS.items() if word not in ('rr', 'rl')}
ENDS = ('front', 'rear', 'hind')
SIDELESS = ('head', 'torso', 'wheels')
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


def words_of(name: str) -> list[str]:
    """
    Split the name of a joint, such as `left_knee2` or `LHipYaw`, into words in lower case.

    Parameters
    ----------
    name
        The name; digits in it are dropped.

    """
    words = re.findall(
        r'[A-Z]+(?![a-z])|[A-Z]?[a-z]+', re.sub(r'([A-Z])([A-Z][a-z])', r'\1_\2', name)
    )
    return [word.lower() for word in words]


def kind_of(words: Sequence[str]) -> str | None:
    """
    Find the kind of limb that matches the words of a joint name.

    Parameters
    ----------
    words
        The words of the joint name, in lower case.

    Returns
    -------
    str or None
        A key of `KINDS`, the first one with a matching word; None if no word matches.

    """
    for kind, known in KINDS.items():
        if any(word.removesuffix('s') in known.split() for word in words):
            return kind
    return None


def side_of(words: Sequence[str], kind: str | None) -> str | None:
    """
    Find the side, or the corner of a quadruped, that matches the words of a joint name.

    Parameters
    ----------
    words
        The words of the joint name, in lower case.
    kind
        The kind of limb; kinds in `SIDELESS` have no side.

    Returns
    -------
    str or None
        For example 'left' or 'front right'; None if no word denotes a side.

    """
    if kind in SIDELESS:
        return None
    for place, word in enumerate(words):
        if word in CORNERS:
            return CORNERS[word]
        # A single letter denotes a side only at the start or end of a name.
        if word in SIDES and (len(word) > 1 or place in (0, len(words) - 1)):
            return ' '.join([*(end for end in ENDS if end in words), SIDES[word]])
    return None


def short_name(name: str, side: str | None) -> str:
    """
    Strip the side from the start of a joint name.

    Parameters
    ----------
    name
        The name, for example `left_knee`.
    side
        The side in the title of the group; names that start with another side are unchanged.

    """
    first, _, rest = name.partition('_')
    is_side = side is not None and side_of([first.lower()], None) == side
    return rest if is_side and rest else name
