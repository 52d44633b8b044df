# SPDX-License-Identifier: Apache-2.0
"""Detection of joints without a state and of misspelt joint names."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ros_environment.suggestions import closest_name
from urdf import RobotModel

__all__ = ['StateWatch']


class StateWatch:
    """
    Detects joints without a state and misspelt joint names, each of which is reported once.

    Parameters
    ----------
    model
        The robot.

    """

    def __init__(self, model: RobotModel) -> None:
        mimics = model.mimics
        self._names = {joint.name for joint in model.moving_joints}
        self._needed = [joint.name for joint in model.moving_joints if joint.name not in mimics]
        self._seen: set[str] = set()
        self._unknown: set[str] = set()
        self._complained = False

    @property
    def missing(self) -> list[str]:
        """Return the joints without a state; mimic joints need none."""
        return [name for name in self._needed if name not in self._seen]

    def misspelt(self, names: Iterable[str]) -> Iterator[str]:
        """
        Record the names of a joint state, and warn of those that resemble a joint without a state.

        Names that resemble no such joint belong to other robots. Names are recorded on the first
        iteration.

        Parameters
        ----------
        names
            The joints of the state.

        Yields
        ------
        str
            A warning for each misspelt name that is new.

        """
        new = [name for name in names if name not in self._seen]
        self._seen.update(new)
        for name in new:
            if name in self._names:
                continue
            meant = closest_name(name, self._names - self._seen, 0.75)
            if meant:
                yield (
                    f"The joint states name '{name}', but the robot has no such joint. "
                    f"Did you mean '{meant}'?"
                )

    def unknown(self, names: Iterable[str]) -> Iterator[str]:
        """
        Warn of joints whose position is not finite, once for each joint.

        Parameters
        ----------
        names
            The joints without a finite position in a joint state; names of other robots are
            ignored.

        Yields
        ------
        str
            The warnings, sorted by name.

        """
        new = self._names.intersection(names) - self._unknown
        self._unknown |= new
        for name in sorted(new):
            yield (
                f"The position of joint '{name}' in a joint state is not a number, which means "
                'that it is unknown: the joint keeps its last pose.'
            )

    def complaint(self, publishers: int, topic: str) -> str | None:
        """
        Format the warning that names the joints without a state.

        Parameters
        ----------
        publishers
            The number of publishers of the topic.
        topic
            The topic of the joint states.

        Returns
        -------
        str or None
            None if all joints have had a state.

        """
        missing = self.missing
        if not missing:
            return None
        self._complained = True
        names = ', '.join(f"'{name}'" for name in missing)
        return (
            f'{_some(len(missing), len(self._needed))} had no state so far, so tf does not '
            f'know where the links below them are: {names}. {_sources(publishers, topic)}'
        )

    def relief(self) -> str | None:
        """Format the message that all joints have a state now, if some were reported before."""
        if not self._complained or self.missing:
            return None
        self._complained = False
        return f'{_all(len(self._needed))} a state now.'


def _all(needed: int) -> str:
    """Format the start of a message about all joints."""
    return 'The only joint has' if needed == 1 else f'All {needed} joints have'


def _some(missing: int, needed: int) -> str:
    """Format the start of a message about the missing joints."""
    if missing == needed:
        return _all(needed)
    return f'{missing} of {needed} joints ' + ('has' if missing == 1 else 'have')


def _sources(publishers: int, topic: str) -> str:
    """Format the number of publishers of the joint states."""
    if publishers == 0:
        return f'There is no publisher on {topic}.'
    nodes = 'one publisher' if publishers == 1 else f'{publishers} publishers'
    return f'{topic} has {nodes}.'
