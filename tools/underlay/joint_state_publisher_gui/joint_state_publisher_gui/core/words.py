# SPDX-License-Identifier: Apache-2.0
"""Derivation of limb and side from the words in joint names."""

from __future__ import annotations

from collections.abc import Sequence
import re

__all__ = ['SIDELESS', 'kind_of', 'short_name', 'side_of', 'words_of']

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
