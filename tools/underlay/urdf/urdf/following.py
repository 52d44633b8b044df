# SPDX-License-Identifier: Apache-2.0
"""Resolve chains of mimic joints."""

from __future__ import annotations

from collections.abc import Container, Mapping

from urdf.joint import Mimic

__all__ = ['check_for_loops', 'followed']


def followed(name: str, mimics: Mapping[str, Mimic], known: Container[str]) -> Mimic | None:
    """
    Resolve a chain of mimic joints to the first joint in it whose position is known.

    Parameters
    ----------
    name
        The joint name; a known joint resolves to itself.
    mimics
        The mimic relations by joint name.
    known
        The joints whose positions are known.

    Returns
    -------
    Mimic or None
        The known joint with the multiplier and offset (rad or m) of the whole chain; None if no
        joint of the chain is known.

    """
    multiplier, offset = 1.0, 0.0
    while name not in known:
        mimic = mimics.get(name)
        if mimic is None:
            return None
        offset += multiplier * mimic.offset
        multiplier *= mimic.multiplier
        name = mimic.joint
    return Mimic(name, multiplier, offset)


def check_for_loops(mimics: Mapping[str, Mimic]) -> None:
    """
    Check that no mimic joints follow each other in a loop.

    Parameters
    ----------
    mimics
        The mimic relations by joint name.

    Raises
    ------
    ValueError
        There is a loop; the message contains the names of its joints, joined by ' -> '.

    """
    for name in mimics:
        chain = [name]
        while chain[-1] in mimics:
            chain.append(mimics[chain[-1]].joint)
            if chain[-1] == name:
                raise ValueError(' -> '.join(chain))
            if chain[-1] in chain[:-1]:
                break
