# SPDX-License-Identifier: Apache-2.0
"""Detect arguments that a xacro file does not declare."""

from __future__ import annotations

from collections.abc import Mapping


class WatchedArguments(dict[str, str]):
    """
    Arguments of a xacro file, which record the names that the file declares or uses.

    Parameters
    ----------
    given
        The command line arguments by name.

    """

    def __init__(self, given: Mapping[str, str]) -> None:
        super().__init__(given)
        self._given = list(given)
        self._asked: set[str] = set()

    def __contains__(self, name: object) -> bool:
        self._asked.add(str(name))
        return super().__contains__(name)

    def __getitem__(self, name: str) -> str:
        self._asked.add(name)
        return super().__getitem__(name)

    def unknown(self) -> list[str]:
        """Return a message for each given argument that was never accessed."""
        return [_sentence(name, self._asked) for name in self._given if name not in self._asked]


def _sentence(name: str, known: set[str]) -> str:
    from launch._did_you_mean import did_you_mean

    hint = did_you_mean(name, known)
    if not hint and known:
        hint = f'The arguments are: {", ".join(sorted(known))}'
    return f"no <xacro:arg> declares '{name}', so it changes nothing. {hint}".rstrip()
